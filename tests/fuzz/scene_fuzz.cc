// Input: the text of a scene file.
#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/read_as_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = talus::fuzz::text({data, size});
  talus::fuzz::read_as_scene(text, text);
  return 0;
}
