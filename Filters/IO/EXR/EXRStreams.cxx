#include "EXR/EXRStreams.h"

#include "Common/FileError.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

namespace activesurface
{

EXRInput::EXRInput(const std::string& name, const EXRMemory& memory)
  : Imf::IStream(name.c_str())
  , Memory(memory.Bytes)
  , Size(memory.Size)
{
  if (!this->Memory)
  {
    this->Open(name);
  }
}

void EXRInput::Open(const std::string& name)
{
  std::error_code error;
  const auto status = std::filesystem::status(name, error);
  if (!std::filesystem::exists(status))
  {
    throw FileError(vtkErrorCode::FileNotFoundError,
      "there is no such file, or no permission to search its folder");
  }
  if (std::filesystem::is_directory(status))
  {
    throw FileError(vtkErrorCode::CannotOpenFileError, "it is a folder");
  }
  this->File.open(name, std::ios::binary | std::ios::ate);
  const std::streamoff size = this->File.tellg();
  if (!this->File || size < 0)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError,
      std::string("it cannot be opened: ") + std::strerror(errno));
  }
  this->Size = static_cast<std::uint64_t>(size);
  this->seekg(0);
}

bool EXRInput::read(char bytes[], int count)
{
  if (count < 0 || static_cast<std::uint64_t>(count) > this->Size - this->Position)
  {
    this->EndedEarly = true;
    throw FileError(
      vtkErrorCode::PrematureEndOfFileError, "it ends too early; copy or write it again");
  }
  if (this->Memory)
  {
    std::copy_n(this->Memory + this->Position, count, bytes);
  }
  else if (!this->File.read(bytes, count))
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
    throw FileError(
      vtkErrorCode::PrematureEndOfFileError, "it ends too early; copy or write it again");
  }
  if (!this->Memory)
  {
    this->File.clear();
    this->File.seekg(static_cast<std::streamoff>(position));
  }
  this->Position = position;
}

EXROutput::EXROutput(const std::string& name)
  : Imf::OStream(name.c_str())
  , File(std::fopen(name.c_str(), "wb"))
{
  if (!this->File)
  {
    throw FileError(vtkErrorCode::CannotOpenFileError,
      std::string("the file cannot be created: ") + std::strerror(errno) +
        "; check its name, and that its folder exists and may be written to");
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
