# Run at every build, as cmake -DSOURCE=... -DOUTPUT=... -P: writes a header with the commit as git describes it, which is touched only
# when that has changed. Without git or outside of a repository the commit is "unknown".
cmake_minimum_required(VERSION 3.25)
set(ENV{GIT_OPTIONAL_LOCKS} 0)  # somebody may be committing just now
execute_process(COMMAND git describe --always --dirty --abbrev=12 WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE commit RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(failed)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define DMOSCOPE_COMMIT \"@commit@\"\n" @ONLY)
