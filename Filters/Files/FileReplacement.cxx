#include "FileReplacement.h"

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

namespace activesurface
{

namespace
{

// Returns a name unique to the process and the object, so that two writers on one machine share no
// temporary file.
std::string MakeTemporaryName(const std::string& name)
{
  static std::atomic<unsigned> count{ 0 };
  return name + "." + std::to_string(getpid()) + "-" + std::to_string(++count) + ".part";
}

}

FileReplacement::FileReplacement(const std::string& name)
  : Name(name)
  , TemporaryName(MakeTemporaryName(name))
{
  std::error_code error;
  const auto status = std::filesystem::status(name, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
  {
    throw std::runtime_error("its name is that of a folder, device or pipe; choose another name");
  }
}

FileReplacement::~FileReplacement()
{
  if (!this->Finished)
  {
    std::remove(this->TemporaryName.c_str());
  }
}

void FileReplacement::Finish()
{
  std::error_code error;
  std::filesystem::rename(this->TemporaryName, this->Name, error);
  if (error)
  {
    throw std::runtime_error(
      "the temporary file with the data cannot be renamed to this name: " + error.message());
  }
  this->Finished = true;
}

}
