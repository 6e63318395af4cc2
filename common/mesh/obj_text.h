#pragma once
// The lines of a Wavefront OBJ file from which a mesh is read.

#include <filesystem>
#include <string>

namespace talus {

/// Largest OBJ file that is read [bytes]: up to it, reading takes less than 512 MiB of memory.
constexpr std::uintmax_t largest_obj_file = 8u << 20;
/// Most corners of one face. A face of more is to be cut by the program that wrote it.
constexpr std::size_t most_face_corners = 255;

/// The file's lines for corners (v), faces (f), objects (o) and groups (g). All others are left out, so that no file
/// that an OBJ file names, such as a library of materials (mtllib), is ever opened.
/// Throws std::invalid_argument with file, line and rule when the file cannot be read or is larger than
/// largest_obj_file, or is not in UTF-8, when a corner is not three numbers from
/// -1e30 to 1e30, and when a face has fewer than 3 or more than
/// most_face_corners corners or a number of a corner that does not exist.
std::string checked_obj_text(const std::filesystem::path& file);

}  // namespace talus
