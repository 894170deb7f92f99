# swarmsmith_late_program(NAME LATE beginning... SOURCES ... PRIVATE ...): a program in build/bin. Shared libraries
# whose names begin with one of LATE are loaded when one of their functions is first called, not at the start: `--help`
# and shell completion need none of them. The program is linked twice: with all libraries, as build/whole/NAME-whole,
# from which packages and archives get the list of needed libraries; and with a stub for each function of these
# libraries that it uses (late_libraries.py). The stubs are for x86-64; on other processors, and under sanitizers, the
# program is linked once and loads all libraries at its start.
function(swarmsmith_late_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "LATE;SOURCES;PRIVATE")
  if(NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" OR CMAKE_CROSSCOMPILING OR SWARMSMITH_SANITIZE)
    swarmsmith_program(${name} SOURCES ${arg_SOURCES} PRIVATE ${arg_PRIVATE})
    return()
  endif()
  set(whole ${name}-whole)
  swarmsmith_program(${whole} SOURCES ${arg_SOURCES} PRIVATE ${arg_PRIVATE})
  set_target_properties(${whole} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/whole)
  set(stubs ${CMAKE_CURRENT_BINARY_DIR}/${name}-late.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/late_libraries.py)
  add_custom_command(OUTPUT ${stubs} DEPENDS ${whole} ${script} VERBATIM
    COMMAND ${Python3_EXECUTABLE} ${script} $<TARGET_FILE:${whole}> ${stubs} ${arg_LATE})
  add_executable(${name} $<TARGET_OBJECTS:${whole}> ${stubs})
  target_link_libraries(${name} PRIVATE ${arg_PRIVATE})
  # The libraries whose functions all have stubs are not linked.
  target_link_options(${name} PRIVATE -Wl,--as-needed)
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
endfunction()
