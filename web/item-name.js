// SPDX-FileCopyrightText: 2026 The Omnistereo authors
// SPDX-License-Identifier: Apache-2.0

// The name of an item of view.json for people.
export const itemName = ({ title, name } = {}) => title ?? name ?? '';

// For visitors, who need no file's name: what it is called before _360 or _180.
export const plainName = (item) => item?.title ?? itemName(item).replace(/[ ._-](?=(360|180)(?!\d)).*$|\.\w+$/, '');
