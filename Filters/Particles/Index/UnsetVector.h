// Vector whose resize leaves new elements uninitialised. The parallel tasks that fill a large array
// are then the first to access its memory. This first access is a large part of the work.

#ifndef UnsetVector_h
#define UnsetVector_h

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace activesurface
{

template <class T>
struct UnsetAllocator : std::allocator<T>
{
  static_assert(std::is_trivially_default_constructible_v<T>, "other types would be set");

  // NOLINTBEGIN(readability-identifier-naming): the names are the standard library's
  template <class U>
  struct rebind
  {
    using other = UnsetAllocator<U>;
  };

  void construct(T* place) noexcept { ::new (static_cast<void*>(place)) T; }

  template <class... Arguments>
  void construct(T* place, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(place)) T(std::forward<Arguments>(arguments)...);
  }
  // NOLINTEND(readability-identifier-naming)
};

template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

}

#endif
