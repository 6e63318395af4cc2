# Run at build time: writes OUTPUT, a header with the layout of every message type, from the .lcm files TYPES.
# The check of layouts in wire.cc and the room in message.h follow from it, so a field is declared in its .lcm file alone.

cmake_minimum_required(VERSION 3.25)

# In a CMake list `;` separates and `[` protects: both are replaced while a file is parsed.
function(read_struct file name_variable fields_variable)
  file(READ ${file} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REPLACE ";" "|" text "${text}")
  string(REGEX REPLACE "\\[([a-z0-9_]+)\\]" ":\\1" text "${text}")
  string(REGEX MATCH "struct ([a-z0-9_]+)" unused "${text}")
  set(${name_variable} ${CMAKE_MATCH_1} PARENT_SCOPE)
  string(REGEX REPLACE "^.*{" "" text "${text}")
  string(REGEX REPLACE "const [^|]*\\|" "" text "${text}")
  string(REGEX MATCHALL "[a-z0-9_]+ +[a-z0-9_:]+ *\\|" fields "${text}")
  set(${fields_variable} "${fields}" PARENT_SCOPE)
endfunction()

# The initialiser of one field; `names` are those of the fields so far, among which a count is looked up.
function(field_entry field names entry_variable name_variable)
  string(REGEX MATCH "([a-z0-9_]+) +([a-z0-9_]+):?([a-z0-9_]*)" unused "${field}")
  set(type ${CMAKE_MATCH_1})
  set(name ${CMAKE_MATCH_2})
  set(count "${CMAKE_MATCH_3}")
  set(entries "")
  if(count MATCHES "^[0-9]+$")
    set(entries ", .number = ${count}")
  elseif(count)
    list(FIND names ${count} index)
    set(entries ", .count_field = ${index}")
  endif()
  if(type MATCHES "^talus_")
    set(entries "${entries}, .fields = layout_of_${type}")
    set(type "message")
  endif()
  set(${entry_variable} "    {.name = \"${name}\", .type = FieldType::${type}_field${entries}},\n" PARENT_SCOPE)
  set(${name_variable} ${name} PARENT_SCOPE)
endfunction()

set(includes "")
set(nested_layouts "")
set(channel_layouts "")
set(each "")
foreach(file IN LISTS TYPES)
  read_struct(${file} struct fields)
  set(names "")
  set(entries "")
  set(layout "")
  foreach(field IN LISTS fields)
    field_entry("${field}" "${names}" entry name)
    list(APPEND names ${name})
    string(APPEND entries "${entry}")
  endforeach()
  string(APPEND layout "inline constexpr MessageField layout_of_${struct}[] = {\n${entries}};\n"
         "template <>\ninline constexpr std::span<const MessageField> layout<talus_lcm::${struct}> = layout_of_${struct};\n\n")
  string(APPEND includes "#include \"talus_lcm/${struct}.hpp\"\n")
  if("crc32" IN_LIST names)
    string(APPEND channel_layouts "${layout}")
    string(APPEND each " \\\n  USE(talus_lcm::${struct})")
  else()
    string(APPEND nested_layouts "${layout}")
  endif()
endforeach()

# The code of lcm-gen compares pointers in a way that ISO C++ does not have.
set(includes "#pragma GCC diagnostic push\n#pragma GCC diagnostic ignored \"-Wpedantic\"\n${includes}#pragma GCC diagnostic pop\n")
file(WRITE ${OUTPUT} "// Made by write_layouts.cmake from the .lcm files.\n#pragma once\n\n${includes}\n"
     "#include \"lcmtypes/layout.h\"\n\nnamespace talus {\n\n${nested_layouts}${channel_layouts}"
     "}  // namespace talus\n\n/// Uses a macro of one argument with each type that is sent by itself.\n"
     "#define TALUS_EACH_MESSAGE(USE)${each}\n")
