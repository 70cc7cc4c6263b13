# cmake -DSOURCE=... -DOUTPUT=... -P commit.cmake: writes a header that says which commit is built. It runs in every build,
# since what is checked out changes without a configuration, and touches the header only when it says something else.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define REND_COMMIT \"${commit}\"\n" @ONLY)
