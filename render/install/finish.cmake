# Run by cpack on the staged files: adds the documents that Debian requires in each package.
function(output result)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE out OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  set(${result} "${out}" PARENT_SCOPE)
endfunction()
output(date git -C ${CPACK_REND_SOURCE} log -1 --date=rfc2822 --format=%cd)
output(contact git -C ${CPACK_REND_SOURCE} log -1 "--format=%cn <%ce>")

# Third-party parts within the program: the font of its HUD, and the part of Dear ImGui that draws it.
set(copyright "rend, by the people whom its history names. They have stated no licence.\n")
set(held "")
if(CPACK_REND_HUD)
  set(held fonts-inter libimgui-dev)
endif()
foreach(other IN LISTS held)
  file(READ /usr/share/doc/${other}/copyright terms)
  string(APPEND copyright "\n\nThe program holds a part of ${other}, under these terms:\n\n${terms}")
endforeach()

# write(PACKAGE COMPONENT)
function(write package component)
  set(folder ${CPACK_TEMPORARY_DIRECTORY}/${component}/usr/share/doc/${package})
  file(MAKE_DIRECTORY ${folder})
  file(WRITE ${folder}/copyright "${copyright}")
  file(WRITE ${folder}/changelog.gz.text "${package} (${CPACK_PACKAGE_VERSION}) unstable; urgency=low\n\n"
       "  * As of its commit; its history says more.\n\n -- ${contact}  ${date}\n")
  execute_process(COMMAND gzip -9n INPUT_FILE ${folder}/changelog.gz.text OUTPUT_FILE ${folder}/changelog.gz
                  COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE ${folder}/changelog.gz.text)
endfunction()
write(rend program)
write(librend-dev development)
