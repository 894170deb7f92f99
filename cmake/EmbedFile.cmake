# swarmsmith_embed_file(TARGET SYMBOL FILE): makes the bytes of FILE a constant of TARGET: `extern "C"` SYMBOL_begin and
# SYMBOL_end, one past its last byte. Another command may generate FILE.
enable_language(ASM)

function(swarmsmith_embed_file target symbol file)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded/${symbol}.S)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT "  .section .rodata
  .global @symbol@_begin
  .global @symbol@_end
@symbol@_begin:
  .incbin \"@file@\"
@symbol@_end:
  .byte 0
  .section .note.GNU-stack,\"\",%progbits
")
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS ${file} SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${source})
endfunction()
