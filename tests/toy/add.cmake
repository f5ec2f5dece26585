# cmake -DSOURCE=… -DSCRATCH=… -P add.cmake: see README.md. A second run builds what has changed;
# the sources are copied anew, with their times, as one that is gone must not stay.
file(REMOVE_RECURSE ${SCRATCH}/source)
foreach(part CMakeLists.txt common proto server client shaders tests)
  file(COPY ${SOURCE}/${part} DESTINATION ${SCRATCH}/source)
endforeach()
file(COPY ${SOURCE}/tests/toy/toy.glsl DESTINATION ${SCRATCH}/source/shaders/models)
set(def ${SCRATCH}/source/common/models/models.def)
file(READ ${SOURCE}/common/models/models.def text)
set(line "METAMER_MODEL(59, toy, Toy, \"this test\", \"a step\", weighted | highlighted, METAMER_PARAMETER(edge, 0.9, 0, 1, \"\", \"N·H of the step\"))")
string(REPLACE "METAMER_DIFFUSE(60" "${line}\nMETAMER_DIFFUSE(60" with_line "${text}")
if(with_line STREQUAL text)
  message(FATAL_ERROR "models.def has no line METAMER_DIFFUSE(60 before which to add a model")
endif()
file(WRITE ${def} "${with_line}")

configure_file(${SOURCE}/tests/toy/toy_light.glsl ${SCRATCH}/source/shaders/lights/toy.glsl COPYONLY)
set(def ${SCRATCH}/source/common/lights/lights.def)
file(READ ${SOURCE}/common/lights/lights.def text)
set(line "METAMER_LIGHT(59, toy, Toy, \"this test\", \"a step\", METAMER_POSITION(position, \"where it is\") METAMER_DIRECTION(direction, \"its axis\") METAMER_PARAMETER(edge, 0.9, 0, 1, \"\", \"cosine of the step\"))")
string(REPLACE "// clang-format on" "${line}\n// clang-format on" with_line "${text}")
if(with_line STREQUAL text)
  message(FATAL_ERROR "lights.def has no line // clang-format on before which to add a light")
endif()
file(WRITE ${def} "${with_line}")

# A kind of factor: a file, a line in the table, a number in the message.
file(COPY_FILE ${SOURCE}/tests/toy/toy_factor.h ${SCRATCH}/source/common/transport/factors/toy.h)
set(def ${SCRATCH}/source/common/transport/factors.def)
file(READ ${def} text)
string(REGEX MATCHALL "\nMETAMER_FACTOR\\(" lines "${text}")
list(LENGTH lines number)
string(REPLACE "// clang-format on" "METAMER_FACTOR(${number}, toy, Toy, \"toy\")\n// clang-format on" with_line "${text}")
file(WRITE ${def} "${with_line}")
set(message ${SCRATCH}/source/proto/metamer/v1/factors.proto)
file(READ ${message} text)
string(REPLACE "  FACTOR_FRESNEL" "  FACTOR_TOY = ${number};\n  FACTOR_FRESNEL" with_line "${text}")
file(WRITE ${message} "${with_line}")

foreach(command
    "${CMAKE_COMMAND};-P;${SCRATCH}/source/proto/write_tables.cmake"
    "${CMAKE_COMMAND};-S;${SCRATCH}/source;-B;${SCRATCH}/build;-G;Ninja;-DCMAKE_BUILD_TYPE=Debug;-DCMAKE_CXX_FLAGS_DEBUG=-O0"
    "${CMAKE_COMMAND};--build;${SCRATCH}/build;--target;toy_model;toy_factor"
    "${SCRATCH}/build/bin/toy_model"
    "${SCRATCH}/build/bin/toy_factor")
  execute_process(COMMAND ${command} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${command}")
  endif()
endforeach()
