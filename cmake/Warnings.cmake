# Warnings for our own code, as an interface target: it is linked PRIVATE, so that other targets do not inherit them.
add_library(swarmsmith_warnings INTERFACE)
option(SWARMSMITH_WERROR "Warnings are errors, as in the gates: for compilers whose warnings are known" OFF)
target_compile_options(swarmsmith_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wswitch-enum
  -Wnon-virtual-dtor $<$<BOOL:${SWARMSMITH_WERROR}>:-Werror>
  # Designated initialisers leave the other members to the defaults in the struct; this is intended.
  -Wno-missing-field-initializers)
# GCC 12 reports overlaps in `"text" + std::string` that do not exist (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(swarmsmith_warnings INTERFACE -Wno-restrict)
endif()

# The same bits on every machine: no fused multiply-add (GCC contracts by default if the target has it), and never
# -ffast-math. See docs/decisions/0006-own-elementary-functions.md.
add_library(swarmsmith_exact_arithmetic INTERFACE)
target_compile_options(swarmsmith_exact_arithmetic INTERFACE -ffp-contract=off)
