# swarmsmith_score_kinds(TARGET KIND...): the kinds of score that TARGET knows. Each KIND is a pair of
# files, sim/mission/scores/KIND.h and KIND.cpp, with a struct of the same name in camel case. Makes
# sim/mission/score_rule.h in the build tree, the variant of them all; the first is the default.
function(swarmsmith_score_kinds target)
  set(includes)
  set(rules)
  foreach(kind ${ARGN})
    string(APPEND includes "#include \"sim/mission/scores/${kind}.h\"\n")
    string(REPLACE "_" ";" words ${kind})
    set(rule)
    foreach(word ${words})
      string(SUBSTRING ${word} 0 1 first)
      string(SUBSTRING ${word} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND rule "${first}${rest}")
    endforeach()
    list(APPEND rules ${rule})
  endforeach()
  list(JOIN rules ", " rules)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${target}_kinds)
  configure_file(${PROJECT_SOURCE_DIR}/sim/mission/score_rule.h.in
    ${out}/sim/mission/score_rule.h @ONLY)
  target_include_directories(${target} BEFORE PUBLIC ${out})
endfunction()
