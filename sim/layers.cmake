# rend_library(FOLDER [TOOL] DEPENDS folder... LINKS target... [EXCLUDE file...] [ALONE file...])
#
# Makes one library of all .cpp files of FOLDER (such as sim/topology) and lets it include headers of its own
# folder and of DEPENDS and what those depend on, and of no other: the check runs before the library compiles.
# The library of sim/topology is called rend_topology. TOOL: nothing waits for it, so it is compiled with less
# optimisation.

if(CMAKE_SCRIPT_MODE_FILE)
  cmake_policy(VERSION 3.25) # a script starts without policies; IN_LIST needs one
  # The check itself: cmake -DROOT=... -DALLOWED=a,b,c -DFILES=x,y -DSTAMP=... -P layers.cmake
  string(REPLACE "," ";" ALLOWED "${ALLOWED}")
  string(REPLACE "," ";" FILES "${FILES}")
  foreach(file IN LISTS FILES)
    file(STRINGS ${file} includes REGEX "^[ \t]*#[ \t]*include[ \t]+\"(sim|render)/")
    foreach(line IN LISTS includes)
      string(REGEX REPLACE "^[^\"]*\"([^\"]*)/[^/\"]*\".*$" "\\1" folder "${line}")
      if(NOT folder IN_LIST ALLOWED)
        string(REPLACE ";" " " allowed "${ALLOWED}")
        message(FATAL_ERROR "${file} includes from ${folder}; it may include from: ${allowed}")
      endif()
    endforeach()
  endforeach()
  file(TOUCH ${STAMP})
  return()
endif()

function(rend_use_precompiled TARGET HEADERS)
  if(REND_PCH)
    target_precompile_headers(${TARGET} REUSE_FROM ${HEADERS})
    if(CCACHE)
      target_compile_options(${TARGET} PRIVATE -fpch-preprocess)
    endif()
  endif()
endfunction()

# Compiles the files of a library some at a time, as one: most of a file's time goes into headers and their templates.
# What takes long by itself (ALONE in rend_library) stays by itself: it gains nothing, and would be compiled anew with
# each neighbour.
function(rend_use_unity TARGET BATCH)
  if(REND_UNITY)
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${BATCH})
  endif()
endfunction()

function(rend_library FOLDER)
  cmake_parse_arguments(ARG "TOOL" "" "DEPENDS;LINKS;EXCLUDE;ALONE" ${ARGN})
  get_filename_component(name ${FOLDER} NAME)
  if(TARGET rend_${name})
    message(FATAL_ERROR "two folders are called ${name}, and ${FOLDER} is one: libraries are called after their folders")
  endif()
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${FOLDER}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${FOLDER}/*.h)
  foreach(file IN LISTS ARG_EXCLUDE)
    list(REMOVE_ITEM sources ${PROJECT_SOURCE_DIR}/${FOLDER}/${file})
  endforeach()
  set(allowed ${FOLDER})
  set(libraries "")
  foreach(dependency IN LISTS ARG_DEPENDS)
    get_filename_component(library ${dependency} NAME)
    get_property(below GLOBAL PROPERTY REND_ALLOWED_${library})
    list(APPEND allowed ${below})
    list(APPEND libraries rend_${library})
  endforeach()
  list(REMOVE_DUPLICATES allowed)
  set_property(GLOBAL PROPERTY REND_ALLOWED_${name} "${allowed}")

  set(stamp ${CMAKE_CURRENT_BINARY_DIR}/${name}.layers)
  string(REPLACE ";" "," allowed_text "${allowed}")
  set(files ${sources} ${headers})
  string(REPLACE ";" "," files_text "${files}")
  add_custom_command(OUTPUT ${stamp} DEPENDS ${files} ${PROJECT_SOURCE_DIR}/sim/layers.cmake
    COMMAND ${CMAKE_COMMAND} -DALLOWED=${allowed_text} -DFILES=${files_text} -DSTAMP=${stamp}
            -P ${PROJECT_SOURCE_DIR}/sim/layers.cmake
    COMMENT "Layers of ${FOLDER}" VERBATIM)
  add_custom_target(layers_${name} DEPENDS ${stamp})

  if(sources)
    add_library(rend_${name} STATIC ${sources})
    rend_use_unity(rend_${name} 8)
    foreach(file IN LISTS ARG_ALONE)
      set_property(SOURCE ${PROJECT_SOURCE_DIR}/${FOLDER}/${file} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
    endforeach()
    if(ARG_TOOL)
      target_compile_options(rend_${name} PRIVATE ${rend_tool_options})
      rend_use_precompiled(rend_${name} rend_headers_tools)
    else()
      rend_use_precompiled(rend_${name} rend_headers_core)
    endif()
    target_link_libraries(rend_${name} PUBLIC rend_flags ${libraries} ${ARG_LINKS})
  else()
    add_library(rend_${name} INTERFACE)
    target_link_libraries(rend_${name} INTERFACE rend_flags ${libraries} ${ARG_LINKS})
  endif()
  add_dependencies(rend_${name} layers_${name})
  string(REGEX MATCH "^[a-z]+" part ${FOLDER}) # sim, render
  string(TOUPPER ${part} part)
  set_property(GLOBAL APPEND PROPERTY REND_${part}_LIBRARIES rend_${name})
endfunction()
