# Warnings for our own code, as an interface target: linked PRIVATE, so that other targets do not inherit them.
add_library(swarmsmith_warnings INTERFACE)
option(SWARMSMITH_WERROR "Warnings are errors, as in the gates: for compilers whose warnings are known" OFF)
target_compile_options(swarmsmith_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wswitch-enum
  -Wnon-virtual-dtor $<$<BOOL:${SWARMSMITH_WERROR}>:-Werror>
  # Designated initialisers leave the rest to the defaults in the struct: that is their point.
  -Wno-missing-field-initializers)
# GCC 12 sees overlaps in `"text" + std::string` that are not there (its bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(swarmsmith_warnings INTERFACE -Wno-restrict)
endif()

# Same bits on every machine: no fused multiply-add behind our back (GCC contracts by default when
# the target has it), and never -ffast-math. See docs/decisions/0006-own-elementary-functions.md.
add_library(swarmsmith_exact_arithmetic INTERFACE)
target_compile_options(swarmsmith_exact_arithmetic INTERFACE -ffp-contract=off)
