# -DSWARMSMITH_SANITIZE=address,undefined (or thread): the whole tree, tests included. The
# instrumented code makes GCC 12 see uninitialised values in every moved std::variant.
if(SWARMSMITH_SANITIZE)
  add_compile_options(-fsanitize=${SWARMSMITH_SANITIZE} -fno-omit-frame-pointer -g
    -Wno-error=maybe-uninitialized)
  add_link_options(-fsanitize=${SWARMSMITH_SANITIZE})
endif()
