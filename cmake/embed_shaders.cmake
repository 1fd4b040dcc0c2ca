# Writes the shaders as string constants into one source file.
# Usage: cmake -DFOLDER=shaders -DOUT=shaders.cpp -P embed_shaders.cmake
file(GLOB files ${FOLDER}/*.vert ${FOLDER}/*.frag)
list(SORT files)
set(text "#include \"ui/gl/shaders.h\"\n\nnamespace hewn::shaders {\n")
foreach(file ${files})
  get_filename_component(name ${file} NAME)
  string(REPLACE "." "_" name ${name})
  file(READ ${file} content)
  string(APPEND text "extern const char* const ${name} = R\"glsl(${content})glsl\";\n")
endforeach()
string(APPEND text "}  // namespace hewn::shaders\n")
file(WRITE ${OUT} "${text}")
