// Gives a fuzzer the files of a folder, without libFuzzer. So each build compiles the fuzzers, and
// its tests run their corpus. Ignores options of libFuzzer.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace
{

int Replay(const char* folder)
{
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
  {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ++count;
  }
  return count;
}

}

int main(int argc, char** argv)
{
  int count = 0;
  for (int i = 1; i < argc; ++i)
  {
    count += argv[i][0] == '-' ? 0 : Replay(argv[i]);
  }
  std::cout << count << " files\n";
  return count > 0 ? 0 : 1;
}
