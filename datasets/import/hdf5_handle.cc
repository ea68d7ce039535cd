#include "datasets/import/hdf5_handle.h"

#include <algorithm>

namespace hoplab {

std::string Hdf5TextAttribute(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return "";
  const Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose);
  if (!type.ok() || H5Tget_class(type.get()) != H5T_STRING ||
      H5Sget_simple_extent_npoints(space.get()) != 1)
    return "";
  std::string text;
  if (H5Tis_variable_str(type.get()) > 0) {
    char* data = nullptr;
    if (H5Aread(attribute.get(), type.get(), &data) >= 0 && data != nullptr) {
      text = data;
      H5Dvlen_reclaim(type.get(), space.get(), H5P_DEFAULT, &data);
    }
    return text;
  }
  text.resize(H5Tget_size(type.get()));
  if (H5Aread(attribute.get(), type.get(), text.data()) < 0) text.clear();
  text.erase(std::min(text.find('\0'), text.size()));
  return text;
}

}  // namespace hoplab
