# SPDX-FileCopyrightText: 2026 The Omnistereo authors
# SPDX-License-Identifier: Apache-2.0
#
# The dependencies of the library. Read by the build, and by find_package(ods) for an installed library.
find_package(embree 4 QUIET CONFIG)
if(NOT embree_FOUND)
  find_package(embree 3.13 REQUIRED CONFIG)
endif()
foreach(package TBB draco fmt glm meshoptimizer nlohmann_json)  # Debian 13's draco.pc has wrong paths
  find_package(${package} REQUIRED CONFIG)
endforeach()
find_package(PkgConfig REQUIRED)
pkg_check_modules(OpenEXR REQUIRED IMPORTED_TARGET OpenEXR>=3.1)
pkg_check_modules(Deflate REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(Formats REQUIRED IMPORTED_TARGET lcms2 libheif libjpeg libpng libtiff-4>=4.5 libwebp libwebpdemux
  libzip>=1.7 libzstd)
pkg_check_modules(FFmpeg REQUIRED IMPORTED_TARGET libavcodec>=59.37 libavformat libavutil libswresample)
pkg_check_modules(Pango REQUIRED IMPORTED_TARGET pangoft2>=1.50)
set(ods_libraries embree TBB::tbb PkgConfig::Deflate PkgConfig::FFmpeg PkgConfig::OpenEXR PkgConfig::Pango PkgConfig::Formats
  draco::draco meshoptimizer::meshoptimizer fmt::fmt)
