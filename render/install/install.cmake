# What cmake --install puts where, in two components:
#   program      rend, its manual, completions, presets, the schema and the READMEs
#   development  libraries, headers, the CMake package and pkg-config files
# The program itself prints the manual and the completions at installation, so they do not delay a build.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(install_source ${CMAKE_CURRENT_LIST_DIR})
set(install_made ${PROJECT_BINARY_DIR}/install)
get_property(sim_libraries GLOBAL PROPERTY REND_SIM_LIBRARIES)
get_property(render_libraries GLOBAL PROPERTY REND_RENDER_LIBRARIES)
set(hud OFF) # left out if the font is not installed
if(TARGET rend_imgui)
  set(hud ON)
  list(PREPEND render_libraries rend_imgui)
endif()

# The program.
install(TARGETS rend RUNTIME COMPONENT program)
set(REND_MADE ${install_made})
foreach(directory BINDIR MANDIR DATADIR)
  set(REND_${directory} ${CMAKE_INSTALL_${directory}})
endforeach()
configure_file(${install_source}/pages.cmake.in ${install_made}/pages.cmake @ONLY)
install(SCRIPT ${install_made}/pages.cmake COMPONENT program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/presets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/rend/presets COMPONENT program
        FILES_MATCHING PATTERN "*.xml" PATTERN "*.xsd" PATTERN "*.msh" PATTERN "*.obj" PATTERN "*.off" PATTERN "*.moka"
        PATTERN "*.svg" PATTERN "*.png"
        PATTERN gallery EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
foreach(folder presets sim render tests) # targets of its links
  install(FILES ${PROJECT_SOURCE_DIR}/${folder}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT program)
endforeach()

# The libraries: rend::sim, rend::render, which draws what it simulates, and rend::rend, which is all with what commands are
# made of. Those of one folder are called after it: rend::topology.
add_library(rend_sim INTERFACE)
target_link_libraries(rend_sim INTERFACE rend_rules rend_build rend_export rend_check rend_study)
add_library(rend_render INTERFACE)
target_link_libraries(rend_render INTERFACE rend_picture rend_pipeline rend_sim)
add_library(rend_rend INTERFACE)
target_link_libraries(rend_rend INTERFACE rend_commands rend_sim)
target_compile_features(rend_flags INTERFACE cxx_std_20)
target_compile_options(rend_flags INTERFACE $<INSTALL_INTERFACE:-Wno-psabi>)
target_include_directories(rend_flags INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/rend>)
foreach(library IN ITEMS ${sim_libraries} ${render_libraries} rend_flags rend_sim rend_render rend_rend)
  string(REGEX REPLACE "^rend_" "" name ${library})
  set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()
install(TARGETS rend_flags rend_sim ${sim_libraries} EXPORT rend-sim ARCHIVE COMPONENT development)
install(TARGETS rend_rend rend_render ${render_libraries} EXPORT rend-render ARCHIVE COMPONENT development)
foreach(folder sim render)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rend COMPONENT development
          FILES_MATCHING PATTERN "*.h" PATTERN install EXCLUDE)
endforeach()

# find_package(rend)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/rend)
foreach(part sim render)
  install(EXPORT rend-${part} NAMESPACE rend:: DESTINATION ${package_dir} COMPONENT development)
endforeach()
configure_package_config_file(${install_source}/rend-config.cmake.in ${install_made}/rend-config.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${install_made}/rend-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${install_made}/rend-config.cmake ${install_made}/rend-config-version.cmake DESTINATION ${package_dir}
        COMPONENT development)

# pkg-config. A linker processes static libraries once, from left to right: dependents come before dependencies, the
# reverse of the order of definition. All are static, so their dependencies are public, none is private.
function(rend_pkg_config name)
  set(libraries "")
  foreach(library IN LISTS ARGN)
    get_target_property(type ${library} TYPE)
    if(type STREQUAL STATIC_LIBRARY)
      string(PREPEND libraries " -l${library}")
    endif()
  endforeach()
  file(RELATIVE_PATH up /rend/${CMAKE_INSTALL_LIBDIR}/pkgconfig /rend) # relative to the file, so that the installation is relocatable
  configure_file(${install_source}/${name}.pc.in ${install_made}/${name}.pc @ONLY)
  install(FILES ${install_made}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)
endfunction()
set(pictures "osmesa")
if(REND_PNG)
  string(APPEND pictures ", libpng, libdeflate")
endif()
if(REND_JPEG)
  string(APPEND pictures ", libjpeg")
endif()
if(REND_VIDEO)
  string(APPEND pictures ", libavfilter, libavformat, libavcodec, libavutil")
endif()
if(hud)
  string(APPEND pictures ", imgui")
endif()
rend_pkg_config(rend-sim ${sim_libraries})
rend_pkg_config(rend ${render_libraries})

include(${install_source}/package.cmake)
