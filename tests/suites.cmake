# ctest includes this file once for each test program. It asks the program for its tests, and registers one test per
# suite, with the name FOLDER.SUITE. The tests of a suite therefore run in one process and share their set-up.
# Each test that matches a pattern of `full` becomes a test of its own with the label "full".
#   program     the test program
#   folder      the folder of tests/, with dots
#   full        patterns of GoogleTest, separated by colons
#   properties  properties of every registered test
# The last lines of GoogleTest's output if all tests of a process were skipped. CTest ignores the exit code of a process
# whose output matches, so the expression must not match if a test failed.
set(all_skipped "PASSED  \\] 0 tests\\.\n\\[  SKIPPED \\] [0-9]+ tests?, listed below:(\n\\[  SKIPPED \\][^\n]*)*\n*$")

function(add_tests filter whole_suites)
  execute_process(COMMAND ${program} --gtest_list_tests --gtest_filter=${filter} OUTPUT_VARIABLE list
                  COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE " +#[^\n]*" "" list "${list}")
  string(REPLACE "\n" ";" list "${list}")
  foreach(line ${list})
    if(line MATCHES "^([^ ]+)\\.$")
      set(suite ${CMAKE_MATCH_1})
      if(NOT whole_suites OR suite MATCHES "^DISABLED_")
        continue()
      endif()
      set(name ${folder}.${suite})
      add_test(${name} ${program} --gtest_filter=${suite}.*-${full})
    elseif(NOT whole_suites AND NOT suite MATCHES "^DISABLED_" AND line MATCHES "^  ([^ ]+)$")
      set(name ${folder}.${suite}.${CMAKE_MATCH_1})
      add_test(${name} ${program} --gtest_filter=${suite}.${CMAKE_MATCH_1})
      set_tests_properties(${name} PROPERTIES LABELS full)
    else()
      continue()
    endif()
    set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "${all_skipped}" ${properties})
  endforeach()
endfunction()

add_tests("*-${full}" TRUE)
add_tests("${full}" FALSE)
