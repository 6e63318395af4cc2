# Run at each build: writes version.cc again when the commit has changed.
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=8 --dirty=+ --exclude=*
                OUTPUT_VARIABLE TALUS_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT TALUS_COMMIT)
  set(TALUS_COMMIT "no commit")
endif()
configure_file(${SOURCE}/tools/run/version.cc.in ${OUTPUT} @ONLY)
