# Debian packages, by `cpack` in the build folder: rend, and librend-dev with the libraries.
#
# The program's dependencies are found by dpkg-shlibdeps. rend's libraries are static: a program that links them needs
# their dependencies, too.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME rend)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE ${install_source}/version.cmake) # reads the commit from git when packages are made
set(CPACK_PRE_BUILD_SCRIPTS ${install_source}/finish.cmake)
set(CPACK_REND_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_REND_HUD ${hud})
set(CPACK_REND_FONT ${REND_FONT})

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME rend)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS gnuplot-nox)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "ffmpeg, paraview")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "rend turns a preset, a scene in XML, into image sequences and videos
of sheets and solids that deform, tear and break. It simulates them on a
3-dimensional generalized map, and draws without a display. It also
compares pictures, and studies how time schemes trade error for time.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME librend-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "cmake, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "The libraries that rend is made of, static, with their headers, a CMake
package and pkg-config files: generalized maps, rules that edit them,
mechanics, fracture, surfaces and pictures.")
set(needed libeigen3-dev libfmt-dev libtbb-dev libtinyobjloader-dev libosmesa6-dev libexpat1-dev libcli11-dev
    nlohmann-json3-dev)
if(REND_PNG)
  list(APPEND needed libpng-dev libdeflate-dev)
endif()
if(REND_JPEG)
  list(APPEND needed libjpeg-dev)
endif()
if(REND_VIDEO)
  list(APPEND needed libavcodec-dev libavformat-dev libavfilter-dev libavutil-dev)
endif()
if(hud)
  list(APPEND needed libimgui-dev)
endif()
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ${needed})
include(CPack)
