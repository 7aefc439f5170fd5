/**
 * Places for those of numbered leaves that need one.
 */
#ifndef LeafSlots_h
#define LeafSlots_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

class LeafSlots
{
public:
  /** More leaves, which have no place of their own yet. */
  void Resize(std::size_t leaves) { this->Slots.resize(leaves, NoSlot); }

  /** Unless it has one. */
  void Give(std::size_t leaf)
  {
    if (this->Slots[leaf] == NoSlot)
    {
      this->Slots[leaf] = static_cast<std::uint32_t>(this->Next++);
    }
  }

  /** By leaf. Those without share the first one. */
  const std::vector<std::uint32_t>& GetSlots() const { return this->Slots; }
  std::size_t Count() const { return this->Next; }

private:
  static constexpr std::uint32_t NoSlot = 0;
  std::vector<std::uint32_t> Slots;
  std::size_t Next = 1;
};

}

#endif
