# swarmsmith_embed_text(TARGET SYMBOL FILE...): each FILE becomes a constant of TARGET,
# `swarmsmith::SYMBOL`, declared by the generated header embedded/SYMBOL.h (in the build tree).
# Editing the file runs CMake again.
function(swarmsmith_embed_text target symbol file)
  get_filename_component(path ${file} ABSOLUTE)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(READ ${path} text)
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.h @ONLY
    CONTENT "#pragma once\n\nnamespace swarmsmith {\n
inline constexpr char ${symbol}[] = R\"text(@text@)text\";\n\n}  // namespace swarmsmith\n")
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
endfunction()
