# Read by cpack: the version of packages, 0.2.0+git20261122.1a2b3c4d5e6f, or 0.2.0 where the commit is tagged v0.2.0; and
# who made the commit.
function(git result)
  execute_process(COMMAND git -C ${CPACK_REND_SOURCE} ${ARGN} OUTPUT_VARIABLE out OUTPUT_STRIP_TRAILING_WHITESPACE
                  ERROR_QUIET)
  set(${result} "${out}" PARENT_SCOPE)
endfunction()
set(base ${CPACK_PACKAGE_VERSION_MAJOR}.${CPACK_PACKAGE_VERSION_MINOR}.${CPACK_PACKAGE_VERSION_PATCH})
git(tag tag --points-at HEAD v${base})
git(commit log -1 --date=format:%Y%m%d --abbrev=12 --format=git%cd.%h)
set(CPACK_PACKAGE_VERSION ${base})
if(commit AND NOT tag)
  string(APPEND CPACK_PACKAGE_VERSION +${commit})
endif()
set(CPACK_DEBIAN_PACKAGE_VERSION ${CPACK_PACKAGE_VERSION})
git(CPACK_DEBIAN_PACKAGE_MAINTAINER log -1 "--format=%cn <%ce>")
