/**
 * What differs between the versions of OpenVDB that this builds with (10 to 13).
 */
#ifndef OpenVDBCompatibility_h
#define OpenVDBCompatibility_h

namespace activesurface
{

/** Opens an openvdb::io::File, whose grids then do not need it any more: later ones always do so.
 */
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
