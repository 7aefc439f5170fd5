#include "EXR/EXRStreams.h"

#include "FileError.h"

#include <cerrno>
#include <cstring>

namespace activesurface
{

EXRInput::EXRInput(std::istream& stream, const std::string& name)
  : Imf::IStream(name.c_str())
  , Stream(stream)
{
  stream.seekg(0, std::ios::end);
  const std::streamoff size = stream.tellg();
  stream.seekg(0);
  if (!stream || size < 0)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError, "it is no file that can be read");
  }
  this->Size = static_cast<std::uint64_t>(size);
}

bool EXRInput::read(char bytes[], int count)
{
  if (count < 0 || static_cast<std::uint64_t>(count) > this->Size - this->Position)
  {
    this->EndedEarly = true;
    throw FileError(vtkErrorCode::PrematureEndOfFileError, "it ends too early");
  }
  this->Stream.read(bytes, count);
  if (!this->Stream)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError, "it cannot be read to its end");
  }
  this->Position += static_cast<std::uint64_t>(count);
  return this->Position < this->Size;
}

void EXRInput::seekg(std::uint64_t position)
{
  if (position > this->Size)
  {
    this->EndedEarly = true;
    throw FileError(vtkErrorCode::PrematureEndOfFileError, "it ends too early");
  }
  this->Stream.clear();
  this->Stream.seekg(static_cast<std::streamoff>(position));
  this->Position = position;
}

EXROutput::EXROutput(const std::string& name)
  : Imf::OStream(name.c_str())
  , File(std::fopen(name.c_str(), "wb"))
{
  if (!this->File)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError,
      std::string("no file can be made there: ") + std::strerror(errno));
  }
}

EXROutput::~EXROutput()
{
  if (this->File)
  {
    std::fclose(this->File);
  }
}

void EXROutput::write(const char bytes[], int count)
{
  const auto size = static_cast<std::size_t>(count);
  if (std::fwrite(bytes, 1, size, this->File) != size)
  {
    this->Fail();
  }
  this->Position += size;
}

void EXROutput::seekp(std::uint64_t position)
{
  if (std::fseek(this->File, static_cast<long>(position), SEEK_SET) != 0)
  {
    this->Fail();
  }
  this->Position = position;
}

void EXROutput::Close()
{
  std::FILE* file = this->File;
  this->File = nullptr;
  if (std::fclose(file) != 0 || this->ErrorNumber != 0)
  {
    this->Fail();
  }
}

void EXROutput::Fail()
{
  this->ErrorNumber = this->ErrorNumber == 0 ? errno : this->ErrorNumber;
  throw FileError(vtkErrorCode::OutOfDiskSpaceError,
    std::string("it cannot be written to its end: ") + std::strerror(this->ErrorNumber));
}

}
