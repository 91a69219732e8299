# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# The Debian package of the command, for `cpack`: ./run package makes it. Its dependencies are the linked libraries, so
# it is for the release of Debian or Ubuntu on which it was made.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME ods)
set(CPACK_PACKAGE_CONTACT ${contact})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "stereo 360 degree pictures and videos")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL command)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME ods)
set(CPACK_DEBIAN_COMMAND_DESCRIPTION "Renders glTF scenes as omni-directional stereo (ODS) pictures and videos for
headsets: a panorama for each eye, with depth in every direction. Also
converts, checks and tags pictures and videos of other programs, exports its
camera to them, and combines the views of renderers that know only
perspective cameras.")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SUGGESTS "libvulkan1, mesa-vulkan-drivers")  # for graphics cards
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
include(CPack)
