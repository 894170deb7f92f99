# -DSWARMSMITH_SANITIZE=address,undefined (or thread): applies to the whole tree, tests included. A finding ends the
# program. Line tables and -O1 are enough for stack traces, and compile in two thirds of the time. Tests may take
# SWARMSMITH_PATIENCE times as long, and so may waits inside them. In instrumented code, GCC 12 reports uninitialised
# values in every moved std::variant.
set(SWARMSMITH_PATIENCE 1)
if(SWARMSMITH_SANITIZE)
  set(SWARMSMITH_PATIENCE 10)
  add_compile_options(-fsanitize=${SWARMSMITH_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer -O1 -g1
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized>)
  add_link_options(-fsanitize=${SWARMSMITH_SANITIZE})
endif()
