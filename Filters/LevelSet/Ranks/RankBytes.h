/**
 * Numbers and plain structs as bytes that ranks send. All ranks must have the same byte order and
 * sizes of types.
 */
#ifndef RankBytes_h
#define RankBytes_h

#include "Ranks/Communicator.h"

#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace activesurface
{

template <class Value>
void AppendBytes(const std::vector<Value>& values, Bytes& bytes)
{
  static_assert(std::is_trivially_copyable_v<Value>);
  const std::size_t before = bytes.size();
  bytes.resize(before + values.size() * sizeof(Value));
  if (!values.empty())
  {
    std::memcpy(bytes.data() + before, values.data(), values.size() * sizeof(Value));
  }
}

template <class Value>
Bytes ToBytes(const std::vector<Value>& values)
{
  Bytes bytes;
  AppendBytes(values, bytes);
  return bytes;
}

/** Reads values in the order in which they were appended. */
class BytesReader
{
public:
  explicit BytesReader(const Bytes& bytes)
    : Rest(bytes.data())
    , Left(bytes.size())
  {
  }

  template <class Value>
  std::vector<Value> Read(std::size_t count)
  {
    static_assert(std::is_trivially_copyable_v<Value>);
    if (count > this->Left / sizeof(Value))
    {
      throw std::logic_error("Another rank sent fewer bytes than this rank expects; use one "
                             "version of the library on all ranks.");
    }
    std::vector<Value> values(count);
    if (count > 0)
    {
      std::memcpy(values.data(), this->Rest, count * sizeof(Value));
    }
    this->Rest += count * sizeof(Value);
    this->Left -= count * sizeof(Value);
    return values;
  }

private:
  const char* Rest;
  std::size_t Left;
};

template <class Value>
std::vector<Value> FromBytes(const Bytes& bytes)
{
  return BytesReader(bytes).Read<Value>(bytes.size() / sizeof(Value));
}

}

#endif
