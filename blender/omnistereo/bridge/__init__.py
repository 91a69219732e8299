# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
"""From the open scene to files that ods renders. Serves the command and the add-on."""
