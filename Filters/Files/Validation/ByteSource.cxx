#include "Validation/ByteSource.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr std::uint64_t WindowSize = 1 << 16;

[[noreturn]] void RefuseEnd()
{
  throw std::runtime_error("it ends too early, or is damaged; copy or write it again");
}

}

void RefuseDamage(const std::string& what)
{
  throw std::runtime_error("it is damaged: " + what + "; copy or write it again");
}

ByteSource::ByteSource(const std::string& file)
{
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
  {
    throw std::runtime_error("there is no such file, or its folder is not accessible");
  }
  if (!std::filesystem::is_regular_file(status))
  {
    throw std::runtime_error(std::filesystem::is_directory(status) ? "it is a folder, not a file"
                                                                   : "it is not a regular file");
  }
  this->File.open(file, std::ios::binary);
  this->Size = std::filesystem::file_size(file, error);
  if (!this->File || error)
  {
    throw std::runtime_error("it cannot be opened for reading");
  }
}

void ByteSource::Seek(std::uint64_t position)
{
  if (position > this->Size)
  {
    RefuseEnd();
  }
  this->Position = position;
}

void ByteSource::Skip(std::uint64_t count)
{
  if (count > this->GetRest())
  {
    RefuseEnd();
  }
  this->Position += count;
}

void ByteSource::Read(void* bytes, std::size_t count)
{
  if (count > this->GetRest())
  {
    RefuseEnd();
  }
  auto to = static_cast<char*>(bytes);
  while (count > 0)
  {
    const std::uint64_t offset = this->Position - this->WindowBegin;
    if (this->Position < this->WindowBegin || offset >= this->Window.size())
    {
      this->WindowBegin = this->Position;
      this->Window.resize(std::min(WindowSize, this->GetRest()));
      this->File.seekg(static_cast<std::streamoff>(this->Position));
      if (!this->File.read(this->Window.data(), static_cast<std::streamsize>(this->Window.size())))
      {
        throw std::runtime_error("it cannot be read to its end");
      }
      continue;
    }
    const std::size_t part = std::min<std::uint64_t>(count, this->Window.size() - offset);
    std::memcpy(to, this->Window.data() + offset, part);
    to += part;
    count -= part;
    this->Position += part;
  }
}

std::string ByteSource::ReadBytes(std::uint64_t count)
{
  if (count > this->GetRest())
  {
    RefuseEnd();
  }
  std::string bytes(count, '\0');
  this->Read(&bytes[0], bytes.size());
  return bytes;
}

}
