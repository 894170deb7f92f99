# swarmsmith_kinds(NAME KIND...): the kinds of something, of which a variant is made. Each KIND is a header NAME/KIND.h in
# this folder, and a source NAME/KIND.cpp if there is one, with a struct of the same name in camel case. Sets the lists
# NAME_headers and NAME_sources, and the texts NAME_includes and NAME_names (of the structs) for made headers.
function(swarmsmith_kinds name)
  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  foreach(kind ${ARGN})
    string(REPLACE "_" ";" words ${kind})
    set(struct)
    foreach(word ${words})
      string(SUBSTRING ${word} 0 1 first)
      string(SUBSTRING ${word} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND struct "${first}${rest}")
    endforeach()
    list(APPEND names ${struct})
    string(APPEND includes "#include \"${room}/${name}/${kind}.h\"\n")
    list(APPEND headers ${name}/${kind}.h)
    if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/${kind}.cpp)
      list(APPEND sources ${name}/${kind}.cpp)
    endif()
  endforeach()
  list(JOIN names ", " names)
  foreach(result headers sources includes names)
    set(${name}_${result} ${${result}} PARENT_SCOPE)
  endforeach()
endfunction()

# swarmsmith_made_header(TARGET FILE): makes the header FILE, a path from the root, in the build tree out of FILE.in and
# the texts of swarmsmith_kinds; TARGET and what links it include it by that path.
function(swarmsmith_made_header target file)
  set(made ${CMAKE_CURRENT_BINARY_DIR}/made)
  configure_file(${PROJECT_SOURCE_DIR}/${file}.in ${made}/${file} @ONLY)
  target_include_directories(${target} BEFORE PUBLIC ${made})
endfunction()
