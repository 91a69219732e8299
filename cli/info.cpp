// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0
extern "C" int ods_info(int, char**) {
  return 0;
}
