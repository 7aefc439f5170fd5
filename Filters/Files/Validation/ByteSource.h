/**
 * Reads the bytes of a file, never beyond the end.
 */
#ifndef ByteSource_h
#define ByteSource_h

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace activesurface
{

/** Throws std::runtime_error with a sentence about the damage. */
[[noreturn]] void RefuseDamage(const std::string& what);

/** Methods that read or move throw beyond the end of the file. */
class ByteSource
{
public:
  explicit ByteSource(const std::string& file);

  std::uint64_t GetSize() const { return this->Size; }
  std::uint64_t GetPosition() const { return this->Position; }
  std::uint64_t GetRest() const { return this->Size - this->Position; }

  void Seek(std::uint64_t position);
  void Skip(std::uint64_t count);
  void Read(void* bytes, std::size_t count);

  template <class Value>
  Value Read()
  {
    Value value;
    this->Read(&value, sizeof value);
    return value;
  }

  std::string ReadBytes(std::uint64_t count);
  /** Reads a length of four bytes and a text of this length. */
  std::string ReadText() { return this->ReadBytes(this->Read<std::uint32_t>()); }

private:
  ByteSource(const ByteSource&) = delete;
  void operator=(const ByteSource&) = delete;

  std::ifstream File;
  std::uint64_t Size = 0;
  std::uint64_t Position = 0;
  std::vector<char> Window; // bytes of the file from WindowBegin on
  std::uint64_t WindowBegin = 0;
};

}

#endif
