// Streams for OpenEXR that report every error. An input also returns its size in bytes. OpenEXR's
// own output stream ignores errors of the last bytes, which are written when the stream closes.

#ifndef EXRStreams_h
#define EXRStreams_h

#include <ImfIO.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace activesurface
{

// A file's contents in memory, used in place of a file.
struct EXRMemory
{
  const char* Bytes = nullptr;
  std::size_t Size = 0;
};

class EXRInput : public Imf::IStream
{
public:
  // Opens the bytes in memory if there are any, otherwise the file. The bytes have to outlive this
  // object. Throws FileError on failure.
  EXRInput(const std::string& name, const EXRMemory& memory);

  bool read(char bytes[], int count) override;
  std::uint64_t tellg() override { return this->Position; }
  void seekg(std::uint64_t position) override;

  std::uint64_t GetSize() const { return this->Size; }
  // Returns true if a read or a seek went beyond the end.
  bool HasEndedEarly() const { return this->EndedEarly; }

private:
  void Open(const std::string& name);

  std::ifstream File;
  const char* const Memory; // null for a file
  std::uint64_t Size;
  std::uint64_t Position = 0;
  bool EndedEarly = false;
};

class EXROutput : public Imf::OStream
{
public:
  // Creates the file. Throws FileError on failure.
  explicit EXROutput(const std::string& name);
  ~EXROutput() override;

  void write(const char bytes[], int count) override;
  std::uint64_t tellp() override { return this->Position; }
  void seekp(std::uint64_t position) override;

  // Throws FileError unless every byte has reached the file.
  void Close();
  // Returns the errno of the first failure; 0 if there was none.
  int GetErrorNumber() const { return this->ErrorNumber; }

private:
  EXROutput(const EXROutput&) = delete;
  void operator=(const EXROutput&) = delete;

  [[noreturn]] void Fail();

  std::FILE* File;
  std::uint64_t Position = 0;
  int ErrorNumber = 0;
};

}

#endif
