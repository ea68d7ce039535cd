#pragma once

#include <hdf5.h>

#include <string>

namespace hoplab {

/// An identifier of the HDF5 library, closed at the end; negative: the call failed.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  bool ok() const { return id_ >= 0; }
  hid_t get() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// While it lives the library does not print its errors on standard error.
class Hdf5Silence {
 public:
  Hdf5Silence() {
    // It tidies up when the program ends, and says so loudly of a damaged file.
    [[maybe_unused]] static const herr_t kOnce = H5dont_atexit();
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;
  ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// What an attribute of one text says, of fixed or variable length; empty if there is none.
std::string Hdf5TextAttribute(hid_t object, const char* name);

}  // namespace hoplab
