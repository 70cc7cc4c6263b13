# cmake -DCOMPILER=... -DROOT=... -DFILE=... -P must_not_compile.cmake
#
# Compiles FILE; its first line, "// fault: NAME", is the function that the compiler must refuse to call in a
# constant expression, or "none" for a file that must compile.
file(STRINGS ${FILE} first LIMIT_COUNT 1)
string(REGEX REPLACE "^// fault: " "" fault "${first}")
execute_process(COMMAND ${COMPILER} -std=c++20 -fsyntax-only -I${ROOT} ${FILE}
                RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(fault STREQUAL "none")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${FILE} should compile:\n${output}")
  endif()
elseif(result EQUAL 0)
  message(FATAL_ERROR "${FILE} compiles; ${fault} should stop it")
elseif(NOT output MATCHES "error: call to non-[^\n]*rule_fault::${fault}\\(")
  message(FATAL_ERROR "${FILE} does not fail by ${fault}:\n${output}")
endif()
