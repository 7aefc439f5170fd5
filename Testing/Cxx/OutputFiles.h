/**
 * Where a fact leaves its files: a folder of its own, as ctest runs several at once.
 */
#ifndef OutputFiles_h
#define OutputFiles_h

#include <filesystem>
#include <iterator>
#include <string>

/** Set by RunFacts. */
inline std::filesystem::path FolderOfTheFact;

/** The path of a file there. */
inline std::string OutputName(const std::string& name)
{
  std::filesystem::create_directories(FolderOfTheFact);
  return (FolderOfTheFact / name).string();
}

/** A folder there, empty; its path ends in a slash. */
inline std::string EmptyFolder(const std::string& name)
{
  const std::string folder = OutputName(name);
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder + "/";
}

inline std::size_t CountFiles(const std::string& folder)
{
  return static_cast<std::size_t>(std::distance(
    std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
}

#endif
