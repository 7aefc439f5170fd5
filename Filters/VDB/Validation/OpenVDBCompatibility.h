/**
 * Differences between the supported versions of OpenVDB (10 to 13).
 */
#ifndef OpenVDBCompatibility_h
#define OpenVDBCompatibility_h

namespace activesurface
{

/** Opens an openvdb::io::File without delayed loading, so that its grids are independent of the
 * file. Later versions have no delayed loading. */
template <class File>
auto OpenAtOnce(File& file, int) -> decltype(file.open(false))
{
  return file.open(false);
}

template <class File>
auto OpenAtOnce(File& file, long) -> decltype(file.open())
{
  return file.open();
}

template <class File>
void OpenAtOnce(File& file)
{
  OpenAtOnce(file, 0);
}

}

#endif
