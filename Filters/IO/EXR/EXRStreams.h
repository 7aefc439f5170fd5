// Streams for OpenEXR that know their size and report every error. OpenEXR's own output stream
// ignores errors of the last bytes, which are written when it closes.

#ifndef EXRStreams_h
#define EXRStreams_h

#include <ImfIO.h>

#include <cstdint>
#include <cstdio>
#include <istream>
#include <string>

namespace activesurface
{

class EXRInput : public Imf::IStream
{
public:
  // The caller owns the stream, which has to outlive this object.
  EXRInput(std::istream& stream, const std::string& name);

  bool read(char bytes[], int count) override;
  std::uint64_t tellg() override { return this->Position; }
  void seekg(std::uint64_t position) override;
  void clear() override { this->Stream.clear(); }

  std::uint64_t GetSize() const { return this->Size; }
  // Returns true if a read reached beyond the end.
  bool HasEndedEarly() const { return this->EndedEarly; }

private:
  std::istream& Stream;
  std::uint64_t Position = 0;
  std::uint64_t Size = 0;
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
  // The error that stopped the writing; 0 if there was none.
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
