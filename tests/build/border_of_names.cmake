# What stands between the library's header and other people's code: macros, the order of includes, names.

foreach(header IN ITEMS include/shortshot single_include)
  get_filename_component(way "${header}" NAME)
  set(umbrella "-I${PROJECT_SOURCE_DIR}/${header}" "-DHEADER=\"shortshot.hpp\"")
  build_test(include_twice.${way} ${compile_leaves} ${umbrella} -fsyntax-only "${here}/include_twice.cpp")
  foreach(order IN ITEMS BEFORE AFTER "BEFORE;AFTER")
    string(REPLACE ";" "_and_" name "${order}")
    string(TOLOWER "${name}" name)
    list(TRANSFORM order PREPEND "-D" OUTPUT_VARIABLE definitions)
    build_test(hostile_macros.${way}_${name} ${compile} ${umbrella} ${definitions} -fsyntax-only "${here}/hostile_macros.cpp")
  endforeach()
endforeach()

# `using namespace` of the standard library, of PCL (its names, if it is not there) and of ours in one file.
build_test(names_beside_others ${compile} -fsyntax-only "${here}/names_beside_others.cpp")
build_test(names_beside_others.counted "${here}/count_names.sh" "${PROJECT_SOURCE_DIR}/include" 212)  # lengths that are suggested, a struct of them, how frames agree; copies of messages, and what their channels are; diagnose() and what it sees; stored features: a type, how they are made, their layout; a frame under a fixed lamp; a sampler that keeps its memory; normals of depth images: a function and what keeps its memory; marks of where they are needed; models in flash: a view and a recognizer of them, and three functions that write and read them; objects learned on the spot: what keeps them, their memory, a key point; two functions that make models smaller
