// Input from libFuzzer's bytes: numbers one after another, or a file.

#ifndef FuzzInput_h
#define FuzzInput_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <unistd.h>

namespace activesurface
{

// Reads numbers from the front of the bytes, and zeros after the end.
class FuzzInput
{
public:
  FuzzInput(const std::uint8_t* data, std::size_t size)
    : Data(data)
    , Left(size)
  {
  }

  bool IsOver() const { return this->Left == 0; }

  template <class Number>
  Number Take()
  {
    unsigned char bytes[sizeof(Number)] = {};
    const std::size_t count = this->Left < sizeof bytes ? this->Left : sizeof bytes;
    std::memcpy(bytes, this->Data, count);
    this->Data += count;
    this->Left -= count;
    Number number;
    std::memcpy(&number, bytes, sizeof bytes);
    return number;
  }

  int Below(int limit) { return this->Take<std::uint8_t>() % limit; }

  // Returns mostly numbers of [-2, 2), sometimes any number at all, or NaN.
  double TakeNumber()
  {
    const int kind = this->Below(16);
    return kind == 0 ? this->Take<double>()
      : kind == 1    ? this->Take<float>()
                     : this->Take<std::int8_t>() / 64.0;
  }

private:
  const std::uint8_t* Data;
  std::size_t Left;
};

// A file in memory with these bytes, private to this process.
class FuzzFile
{
public:
  FuzzFile(const char* ending, const std::uint8_t* data, std::size_t size)
    : Name("/dev/shm/fuzz." + std::to_string(getpid()) + ending)
  {
    std::ofstream(this->Name, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  FuzzFile(const FuzzFile&) = delete;
  void operator=(const FuzzFile&) = delete;
  ~FuzzFile() { unlink(this->Name.c_str()); }

  const char* GetName() const { return this->Name.c_str(); }

private:
  std::string Name;
};

}

#endif
