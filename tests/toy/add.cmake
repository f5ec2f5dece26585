# cmake -DSOURCE=… -DSCRATCH=… -P add.cmake: see README.md. A second run builds what has changed;
# the sources are copied anew, with their times, as one that is gone must not stay.
file(REMOVE_RECURSE ${SCRATCH}/source)
foreach(part CMakeLists.txt common proto server client shaders tests)
  file(COPY ${SOURCE}/${part} DESTINATION ${SCRATCH}/source)
endforeach()

function(add_file from to)
  configure_file(${SOURCE}/tests/toy/${from} ${SCRATCH}/source/${to} COPYONLY)
endfunction()

# add_line(FILE BEFORE LINE): the line, before the first of these words.
function(add_line file before line)
  file(READ ${SCRATCH}/source/${file} text)
  string(FIND "${text}" "${before}" at)
  if(at EQUAL -1)
    message(FATAL_ERROR "${file} has no \"${before}\" before which to add a line")
  endif()
  string(SUBSTRING "${text}" 0 ${at} head)
  string(SUBSTRING "${text}" ${at} -1 tail)
  file(WRITE ${SCRATCH}/source/${file} "${head}${line}\n${tail}")
endfunction()

# A model.
add_file(toy.glsl shaders/models/toy.glsl)
add_line(common/models/models.def "METAMER_DIFFUSE(60" "METAMER_MODEL(59, toy, Toy, \"this test\", \"a step\", weighted | highlighted, METAMER_PARAMETER(edge, 0.9, 0, 1, \"\", \"N·H of the step\"))")

# A light.
add_file(toy_light.glsl shaders/lights/toy.glsl)
add_line(common/lights/lights.def "// clang-format on" "METAMER_LIGHT(59, toy, Toy, \"this test\", \"a step\", METAMER_POSITION(position, \"where it is\") METAMER_DIRECTION(direction, \"its axis\") METAMER_PARAMETER(edge, 0.9, 0, 1, \"\", \"cosine of the step\"))")

# A kind of factor: a file, a line in the table, a number in the message.
add_file(toy_factor.h common/transport/factors/toy.h)
file(READ ${SOURCE}/common/transport/factors.def text)
string(REGEX MATCHALL "\nMETAMER_FACTOR\\(" lines "${text}")
list(LENGTH lines number)
add_line(common/transport/factors.def "// clang-format on" "METAMER_FACTOR(${number}, toy, Toy, \"toy\")")
add_line(proto/metamer/v1/factors.proto "  FACTOR_FRESNEL" "  FACTOR_TOY = ${number};")

# A method: its files, its member of the schema, and a row on each side.
add_file(toy_method.h server/methods/toy.h)
add_file(toy_method.cpp server/methods/toy.cpp)
add_line(proto/metamer/v1/scene.proto "    Prefilter prefilter" "    ToyMethod toy = 59;")
add_line(proto/metamer/v1/scene.proto "message Prefilter {}" "message ToyMethod {}")
add_line(common/scene/methods.cpp "      {.word = \"prefilter\"" "      {.word = \"toy\", .trials = {{2, \"toy {}\"}}},")
add_line(server/methods/method.cpp "      {.word = \"prefilter\"" "      {.word = \"toy\", .make = make_toy},")
add_line(server/methods/method.cpp "#include \"server/methods/rgb.h\"" "#include \"server/methods/toy.h\"")

foreach(command
    "${CMAKE_COMMAND};-P;${SCRATCH}/source/proto/write_tables.cmake"
    "${CMAKE_COMMAND};-S;${SCRATCH}/source;-B;${SCRATCH}/build;-G;Ninja;-DCMAKE_BUILD_TYPE=Debug;-DCMAKE_CXX_FLAGS_DEBUG=-O0"
    "${CMAKE_COMMAND};--build;${SCRATCH}/build;--target;toy_model;toy_factor;toy_method"
    "${SCRATCH}/build/bin/toy_model"
    "${SCRATCH}/build/bin/toy_factor"
    "${SCRATCH}/build/bin/toy_method")
  execute_process(COMMAND ${command} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${command}")
  endif()
endforeach()
