# In a git checkout, every build runs this script. In a copy without .git, CMake runs it when it configures the build.
# The script fills in the template `input`. If the resulting text differs from the text of the file `output`, the script
# writes the result to `output`.
set(revision unknown)
set(dirty false)
file(STRINGS ${source}/harness/version/revision.txt archived LIMIT_COUNT 1)
if(archived MATCHES "^[0-9a-f]+$")
  set(revision ${archived})
endif()
find_program(GIT git)
if(GIT)
  # A copy of pelage inside another git repository must not record that repository's commit. The script therefore tests
  # whether the top folder of the repository is the source folder.
  execute_process(COMMAND ${GIT} rev-parse --show-toplevel HEAD WORKING_DIRECTORY ${source}
                  OUTPUT_VARIABLE answer RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  string(REPLACE "\n" ";" answer "${answer}")
  file(REAL_PATH ${source} here)
  if(NOT failed AND answer)
    list(GET answer 0 top)
    if(top STREQUAL here)
      list(GET answer 1 revision)
      execute_process(COMMAND ${GIT} --no-optional-locks status --porcelain --untracked-files=no WORKING_DIRECTORY ${source}
                      OUTPUT_VARIABLE changes ERROR_QUIET)
      if(changes)
        set(dirty true)
      endif()
    endif()
  endif()
endif()
configure_file(${input} ${output} @ONLY)
