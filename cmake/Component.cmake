# swarmsmith_share_units(TARGET SOURCE...): in a unity build (CMAKE_UNITY_BUILD, as in ./dev), the source files of a
# target share compilation units; swarmsmith_form_units() decides which files share one.
function(swarmsmith_share_units target)
  if(CMAKE_UNITY_BUILD)
    set_property(GLOBAL APPEND_STRING PROPERTY SWARMSMITH_UNITS "${target};${CMAKE_CURRENT_SOURCE_DIR};${ARGN}\n")
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  endif()
endfunction()

# swarmsmith_form_units(): decides which files of each target share a unit; for all targets together, at the end.
function(swarmsmith_form_units)
  get_property(targets GLOBAL PROPERTY SWARMSMITH_UNITS)
  file(WRITE ${PROJECT_BINARY_DIR}/units.txt "${targets}")
  execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/cmake/units.py ${PROJECT_BINARY_DIR}/units.txt
    OUTPUT_VARIABLE units OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  string(REPLACE "\n" ";" units "${units}")
  foreach(unit IN LISTS units)
    string(REGEX MATCH "^([^=]*)=([0-9]+)=(.*)$" unit "${unit}")
    set_source_files_properties(${CMAKE_MATCH_3} TARGET_DIRECTORY ${CMAKE_MATCH_1}
      PROPERTIES UNITY_GROUP ${CMAKE_MATCH_1}_${CMAKE_MATCH_2})
  endforeach()
endfunction()

# In a release build, -O1 is enough for most folders, and compiles in two thirds of the time of -O3. With it, GCC 12
# reports uninitialised values in moved variants.
set(SWARMSMITH_GNU_RELEASE $<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>)
add_compile_options($<$<CONFIG:Release>:-O1> $<${SWARMSMITH_GNU_RELEASE}:-Wno-error=maybe-uninitialized>)

# swarmsmith_optimise(): compiles this folder and its subfolders with -O3, for code that computes much. Without
# -fno-tree-slp-vectorize, GCC 12 reads pairs of numbers at once that were written one by one, and each such read waits
# for the writes (docs/performance.md). Call it before their targets are defined.
macro(swarmsmith_optimise)
  add_compile_options($<$<CONFIG:Release>:-O3> $<${SWARMSMITH_GNU_RELEASE}:-fno-tree-slp-vectorize>)
  if(SWARMSMITH_WERROR)
    add_compile_options($<${SWARMSMITH_GNU_RELEASE}:-Werror=maybe-uninitialized>)
  endif()
  set(SWARMSMITH_LEVEL _optimised)
endmacro()

# swarmsmith_precompile(TARGET code|text|test): headers that nearly all files include are precompiled once for all
# libraries and programs (code), once for those that use fmt (text), and once for all test programs (test). This is for
# builds by ./dev, with or without ccache, not for the compilers of the gates. GCC treats precompiled headers as our
# code, so its optimiser warns about them; in version 12 that is bug 105651 (see Warnings.cmake). Test programs are then
# compiled by clang, which does not optimise them and takes less than half of GCC's time. They are linked by gold if it
# is installed, in a third of the other linker's time.
function(swarmsmith_precompile target kind)
  if(NOT CMAKE_UNITY_BUILD OR SWARMSMITH_SANITIZE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    return()
  endif()
  if(kind STREQUAL "test")
    find_program(SWARMSMITH_CLANG clang++ REQUIRED)
    find_program(SWARMSMITH_GOLD ld.gold)
    set(launcher ${PROJECT_SOURCE_DIR}/cmake/by_clang ${CMAKE_CXX_COMPILER_LAUNCHER})
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER "${launcher}")
    if(SWARMSMITH_GOLD)
      target_link_options(${target} PRIVATE -fuse-ld=gold)
    endif()
  endif()
  if(SWARMSMITH_LEVEL AND kind STREQUAL "text")
    set(kind code)  # few of the targets that compute much use fmt
  endif()
  # One for each level of optimisation: from GCC 13 on, some processor options depend on it.
  set(common swarmsmith_${kind}_headers${SWARMSMITH_LEVEL})
  if(NOT TARGET ${common})
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/${common}.cpp CONTENT "// Headers alone.\n")
    add_library(${common} OBJECT ${PROJECT_BINARY_DIR}/${common}.cpp)
    target_link_libraries(${common} PRIVATE tl::expected swarmsmith_warnings swarmsmith_exact_arithmetic)
    set(headers <algorithm> <array> <atomic> <charconv> <chrono> <cmath> <filesystem> <fstream> <functional> <map> <memory>
      <mutex> <numeric> <optional> <set> <span> <sstream> <string> <thread> <tl/expected.hpp> <unordered_map> <variant>
      <vector>)
    if(kind STREQUAL "text")
      list(APPEND headers <fmt/format.h>)
      target_link_libraries(${common} PRIVATE fmt::fmt)
    elseif(kind STREQUAL "test")
      list(APPEND headers <gmock/gmock.h> <gtest/gtest.h>)
      target_link_libraries(${common} PRIVATE GTest::gmock)
      set_target_properties(${common} PROPERTIES CXX_COMPILER_LAUNCHER "${launcher}")
    endif()
    target_precompile_headers(${common} PRIVATE ${headers})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${common})
  target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
endfunction()

# swarmsmith_precompile_code(TARGET LIBRARY...): includes the headers of fmt if fmt is among the libraries.
function(swarmsmith_precompile_code target)
  if("fmt::fmt" IN_LIST ARGN)
    swarmsmith_precompile(${target} text)
  else()
    swarmsmith_precompile(${target} code)
  endif()
endfunction()

# swarmsmith_component(NAME SOURCES ... HEADERS ... PUBLIC ... PRIVATE ...)
#
# A component is one folder and one static library swarmsmith_NAME. HEADERS are the public headers of the folder; the
# target all_verify_interface_header_sets compiles each of them separately. Paths of includes start at the root.
function(swarmsmith_component name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;PUBLIC;PRIVATE")
  set(target swarmsmith_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  swarmsmith_share_units(${target} ${arg_SOURCES})
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR}
    FILES ${arg_HEADERS})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC}
    PRIVATE ${arg_PRIVATE} swarmsmith_warnings swarmsmith_exact_arithmetic)
  swarmsmith_precompile_code(${target} ${arg_PUBLIC} ${arg_PRIVATE})
  set_target_properties(${target} PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
endfunction()

# swarmsmith_program(NAME SOURCES ... PRIVATE ...): a program in build/bin.
function(swarmsmith_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;PRIVATE")
  add_executable(${name} ${arg_SOURCES})
  swarmsmith_share_units(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_PRIVATE} swarmsmith_warnings
    swarmsmith_exact_arithmetic)
  swarmsmith_precompile_code(${name} ${arg_PRIVATE})
endfunction()

# swarmsmith_test(NAME LABEL unit|golden|cluster|end_to_end [WIDE] [TIMEOUT s] SOURCES ... [OPTIMISED ...] USES ...)
#
# A folder has one test program, with one ctest: starting a program takes longer than most of its tests. OPTIMISED:
# sources in whose code, including the inline functions that it calls, the program spends its time. WIDE: `./dev test
# --long` runs it too, and it then does more (tests/support/long_runs.h); its label is then, for example, unit-wide.
# COST: as for scripts.
function(swarmsmith_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "WIDE" "LABEL;TIMEOUT" "SOURCES;OPTIMISED;USES")
  set(label ${arg_LABEL})
  set(usual_limit 300)
  if(arg_WIDE)
    string(APPEND label "-wide")
    set(usual_limit 1200)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT ${usual_limit})
  endif()
  math(EXPR limit "${arg_TIMEOUT} * ${SWARMSMITH_PATIENCE}")
  set(target ${name}_test)
  set(parts ${target})
  if(arg_OPTIMISED)
    # Linked first, since the linker takes the first definition of an inline function that several files have.
    add_library(${target}_optimised OBJECT ${arg_OPTIMISED})
    swarmsmith_share_units(${target}_optimised ${arg_OPTIMISED})
    set(optimised $<TARGET_OBJECTS:${target}_optimised>)
    list(APPEND parts ${target}_optimised)
  endif()
  add_executable(${target} ${optimised} ${arg_SOURCES})
  swarmsmith_share_units(${target} ${arg_SOURCES})
  swarmsmith_precompile(${target} test)
  foreach(part IN LISTS parts)
    target_link_libraries(${part} PRIVATE ${arg_USES} GTest::gmock GTest::gtest_main
      swarmsmith_warnings swarmsmith_exact_arithmetic)
    # The code under test is optimised anyway; with -O1, GCC compiles its tests in two thirds of the time.
    target_compile_options(${part} PRIVATE $<$<CONFIG:Release>:-O1>)
    target_compile_definitions(${part} PRIVATE
      SWARMSMITH_TEST_DATA="${PROJECT_SOURCE_DIR}/tests/golden"
      SWARMSMITH_BIN_DIR="${CMAKE_BINARY_DIR}/bin"
      SWARMSMITH_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
    if(SWARMSMITH_SANITIZE)
      target_compile_definitions(${part} PRIVATE SWARMSMITH_SANITIZED)
    endif()
  endforeach()
  add_test(NAME ${name} COMMAND ${target})
  set_tests_properties(${name} PROPERTIES LABELS ${label} TIMEOUT ${limit} COST ${arg_TIMEOUT})
endfunction()

# swarmsmith_script_test(ROOM.FILE TIMEOUT s [LABEL label] [LONG] [PROCESSORS n] [ORDINARY test...]
#                        [ENVIRONMENT name=value...])
#
# Runs FILE_test.py of this folder with the real programs. LONG: only `./dev test --long` runs it. ORDINARY: these
# classes and tests run each time; all of them run as ROOM.FILE_wide, which is long. COST: ctest begins with the longest
# tests, and the short ones fill the cores at the end.
function(swarmsmith_script_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "LONG" "TIMEOUT;LABEL;PROCESSORS" "ORDINARY;ENVIRONMENT")
  math(EXPR limit "${arg_TIMEOUT} * ${SWARMSMITH_PATIENCE}")
  string(REGEX REPLACE "^.*\\." "" file ${name})
  if(NOT arg_LABEL)
    set(arg_LABEL end_to_end)
  endif()
  if(NOT arg_PROCESSORS)
    set(arg_PROCESSORS 1)
  endif()
  set(runs ${name})
  if(arg_ORDINARY)
    list(APPEND runs ${name}_wide)
  endif()
  foreach(run IN LISTS runs)
    set(words ${arg_ORDINARY})
    set(label ${arg_LABEL})
    if(arg_LONG OR NOT run STREQUAL name)
      set(words)
      list(APPEND label long)
    endif()
    add_test(NAME ${run}
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/${file}_test.py -v ${words})
    set_tests_properties(${run} PROPERTIES LABELS "${label}" TIMEOUT ${limit} COST ${arg_TIMEOUT}
      PROCESSORS ${arg_PROCESSORS} SKIP_REGULAR_EXPRESSION "OK \\(skipped="
      ENVIRONMENT "SWARMSMITH_BIN=${CMAKE_BINARY_DIR}/bin;PYTHONDONTWRITEBYTECODE=1;SWARMSMITH_PATIENCE=${SWARMSMITH_PATIENCE};SWARMSMITH_SOURCE=${PROJECT_SOURCE_DIR};${arg_ENVIRONMENT}")
  endforeach()
endfunction()
