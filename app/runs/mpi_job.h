#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace hoplab {

/// The ranks of an MPI job that share rows of work: rank 0 hands them out, works as well, and is
/// the only one that writes. OpenMPI stays behind this file.
class MpiJob {
 public:
  /// Whether an MPI launcher started this process, by the variables it sets.
  static bool Launched();

  /// Joins the job. One at a time.
  MpiJob();
  MpiJob(const MpiJob&) = delete;
  MpiJob& operator=(const MpiJob&) = delete;
  /// Leaves the job; a rank that never got to its work tells the others so.
  ~MpiJob();

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// What rank 0 says, on every rank; all of them call it, the others with what is not looked at.
  std::string Share(const std::string& text);

  /// A row's text from its index.
  using Compute = std::function<std::string(int row)>;

  struct Served {
    bool stopped = false;
    std::map<int, std::set<int>> lost;  // rank to the rows it had been given and not returned
  };
  /// Rank 0: has `rows` computed, by all ranks and dynamically; `accept` gets each row's text, in
  /// no particular order. Ends early if `stop` is set, which is how the launcher ends the job when
  /// a rank has died; the job can then only be aborted.
  Served Serve(const std::vector<int>& rows, const Compute& compute,
               const std::function<void(int row, const std::string& text)>& accept,
               const std::atomic<bool>* stop);
  /// The other ranks: compute what rank 0 asks for, until it has no more.
  void Work(const Compute& compute);

  /// Ends every rank at once, with this exit code.
  [[noreturn]] void Abort(int code);

 private:
  void Dismiss();
  int rank_ = 0, size_ = 1;
  bool took_part_ = false;
  // Messages that are on their way.
  class Post;
  std::unique_ptr<Post> post_;
  std::string incoming_;
};

}  // namespace hoplab
