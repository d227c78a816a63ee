# Fails on an include that points up. Run as: cmake -D ROOT=<source folder> -P layering_test.cmake
set(back_ends "elastic|plastic|fracture|modal|shell|fluid")
set(faces "^modeler/(cli|python)/")
# Three a rule: files, files among them that it spares, includes it forbids.
set(rules
  "^solver/" "-" "^(io|importer|modeler)/|^(yaml-cpp|CGAL|CLI|nlohmann|GL)/|^png\\.h"
  "^solver/core/" "-" "^solver/(field|energy|minimize|${back_ends})/"
  "^solver/field/" "-" "^solver/(energy|minimize|${back_ends})/"
  "^solver/energy/" "-" "^solver/(minimize|${back_ends})/"
  "^solver/minimize/" "-" "^solver/(${back_ends})/"
  "^" "^solver/minimize/loaded/" "^(ceres/|nlopt)"
  "^" "^modeler/cli/command_line\\.cpp" "^CLI/"
  "^io/" "-" "^(modeler|importer|CGAL|assimp)/"
  "^importer/" "-" "^modeler/"
  "^modeler/" "-" "^(importer|assimp)/"
  "^modeler/" "${faces}" "${faces}|^io/(picture/|output_file\\.h|mesh/mesh_files\\.h)")

file(GLOB_RECURSE sources RELATIVE ${ROOT}
  ${ROOT}/solver/*.h ${ROOT}/solver/*.cpp ${ROOT}/io/*.h ${ROOT}/io/*.cpp
  ${ROOT}/importer/*.h ${ROOT}/importer/*.cpp ${ROOT}/modeler/*.h ${ROOT}/modeler/*.cpp)
if(NOT sources)
  message(FATAL_ERROR "no sources below ROOT=${ROOT}")
endif()
foreach(source IN LISTS sources)
  file(STRINGS ${ROOT}/${source} includes REGEX "^[ \t]*#[ \t]*include")
  list(TRANSFORM includes REPLACE "^[^<\"]*[<\"]([^>\"]*)[>\"].*" "\\1")
  set(left ${rules})
  while(left)
    list(POP_FRONT left files spared forbidden)
    foreach(include IN LISTS includes)
      if(source MATCHES "${files}" AND NOT source MATCHES "${spared}" AND include MATCHES "${forbidden}")
        message(SEND_ERROR "${source} must not include ${include}")
      endif()
    endforeach()
  endwhile()
endforeach()
