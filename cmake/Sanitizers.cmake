# -DSWARMSMITH_SANITIZE=address,undefined (or thread): the whole tree, tests included.
if(SWARMSMITH_SANITIZE)
  add_compile_options(-fsanitize=${SWARMSMITH_SANITIZE} -fno-omit-frame-pointer -g)
  add_link_options(-fsanitize=${SWARMSMITH_SANITIZE})
endif()
