// Replaces a file completely or not at all: the caller writes a temporary file in the same folder,
// and Finish renames the temporary file.
//
//   FileReplacement file("a.vdb");
//   write to file.GetTemporaryName(), throw if that fails
//   file.Finish();

#ifndef FileReplacement_h
#define FileReplacement_h

#include "ActiveFilesExport.h"

#include <string>

namespace activesurface
{

class ACTIVEFILES_EXPORT FileReplacement
{
public:
  // Throws if the name belongs to a folder, a device or another special file.
  explicit FileReplacement(const std::string& name);

  // Removes the temporary file unless Finish succeeded; an existing file is kept.
  ~FileReplacement();

  const std::string& GetTemporaryName() const { return this->TemporaryName; }

  // Throws, with the reason, if the file cannot be renamed.
  void Finish();

private:
  FileReplacement(const FileReplacement&) = delete;
  void operator=(const FileReplacement&) = delete;

  std::string Name;
  std::string TemporaryName;
  bool Finished = false;
};

}

#endif
