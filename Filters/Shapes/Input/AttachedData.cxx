#include "Input/AttachedData.h"

#include "Base/StaticShutdown.h"
#include "Input/AttachedGrid.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkObjectBase.h"

namespace activesurface
{

namespace
{

/** Wraps shared content as an object for vtkInformation. */
template <class Content>
class Attachment : public vtkObjectBase
{
public:
  vtkBaseTypeMacro(Attachment, vtkObjectBase);

  static void Attach(vtkInformation* information, vtkInformationObjectBaseKey* key,
    const std::shared_ptr<const Content>& content)
  {
    if (!content)
    {
      information->Remove(key);
      return;
    }
    auto attachment = new Attachment;
    attachment->InitializeObjectBase();
    attachment->Held = content;
    information->Set(key, attachment);
    attachment->Delete();
  }

  static std::shared_ptr<const Content> Get(
    vtkInformation* information, vtkInformationObjectBaseKey* key)
  {
    auto attachment = dynamic_cast<Attachment*>(information->Get(key));
    return attachment ? attachment->Held : nullptr;
  }

protected:
  ~Attachment() override { ReleaseUnlessExiting(std::move(this->Held)); }

private:
  std::shared_ptr<const Content> Held;
};

/** The keys live as long as VTK's table of keys. */
vtkInformationObjectBaseKey* StateKey()
{
  static auto key = vtkInformationObjectBaseKey::MakeKey("STATE", "activesurface");
  return key;
}

vtkInformationObjectBaseKey* GridKey()
{
  static auto key = vtkInformationObjectBaseKey::MakeKey("GRID", "activesurface");
  return key;
}

}

void Attach(vtkInformation* information, const std::shared_ptr<const AttachedState>& state)
{
  Attachment<AttachedState>::Attach(information, StateKey(), state);
}

std::shared_ptr<const AttachedState> GetAttachedState(vtkInformation* information)
{
  return Attachment<AttachedState>::Get(information, StateKey());
}

void Attach(vtkInformation* information, const openvdb::FloatGrid::ConstPtr& grid)
{
  Attachment<openvdb::FloatGrid>::Attach(information, GridKey(), grid);
}

openvdb::FloatGrid::ConstPtr GetAttachedGrid(vtkInformation* information)
{
  return Attachment<openvdb::FloatGrid>::Get(information, GridKey());
}

bool HasAttachedGrid(vtkInformation* information)
{
  return information->Has(GridKey());
}

void CopyAttachedGrid(vtkInformation* from, vtkInformation* to)
{
  Attach(to, GetAttachedGrid(from));
}

void MoveAttachedGrid(vtkInformation* information, const double offset[3])
{
  if (const openvdb::FloatGrid::ConstPtr grid = GetAttachedGrid(information))
  {
    const openvdb::math::Transform::Ptr transform = grid->transform().copy();
    transform->postTranslate(openvdb::Vec3d(offset));
    Attach(information,
      openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid->copyGridReplacingTransform(transform)));
  }
}

}
