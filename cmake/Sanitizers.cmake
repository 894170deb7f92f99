# -DSWARMSMITH_SANITIZE=address,undefined (or thread): the whole tree, tests included. The
# instrumented code makes GCC 12 see uninitialised values in every moved std::variant.
if(SWARMSMITH_SANITIZE)
  add_compile_options(-fsanitize=${SWARMSMITH_SANITIZE} -fno-omit-frame-pointer -g
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized>)
  if(SWARMSMITH_FUZZ)  # a finding must stop the program
    add_compile_options(-fno-sanitize-recover=all)
  endif()
  add_link_options(-fsanitize=${SWARMSMITH_SANITIZE})
endif()
