# Writes the commit of the sources to a header, if it is another than there: cmake -DSOURCE=… -DHEADER=… -P commit.cmake
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=10 --exclude=* OUTPUT_VARIABLE commit
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
# A folder that lies within somebody else's repository is not ours.
execute_process(COMMAND git -C ${SOURCE} rev-parse --show-prefix OUTPUT_VARIABLE prefix OUTPUT_STRIP_TRAILING_WHITESPACE
                ERROR_QUIET)
if(failed OR prefix)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define VOUSSOIR_COMMIT \"${commit}\"\n")
