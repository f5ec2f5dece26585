# cmake -D PROGRAM=… -D CORPUS=… -D WORK=… -D SECONDS=… -P run.cmake: runs a fuzz
# target from a copy of its corpus. What breaks it stays in WORK as crash-… or timeout-…
file(REMOVE_RECURSE ${WORK})
file(COPY ${CORPUS}/ DESTINATION ${WORK}/corpus)
execute_process(
  COMMAND ${PROGRAM} -max_total_time=${SECONDS} -timeout=10 -rss_limit_mb=1024 -max_len=8192
    -artifact_prefix=${WORK}/ -print_final_stats=1 ${WORK}/corpus
  RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} failed (${result}); its input is in ${WORK}")
endif()
