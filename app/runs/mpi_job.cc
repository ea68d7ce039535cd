#include "app/runs/mpi_job.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>
#include <utility>

#include "app/runs/mpi_library.h"

namespace hoplab {
namespace {

// A worker asks for rows with what it has finished; `kLast` brings the last of it.
enum Tag { kAsk = 1, kLast = 2, kRows = 3 };

constexpr int kLargestChunk = 256;

struct Message {
  int from = 0, tag = 0;
  std::string text;
};

Message Receive(int from, int tag) {
  MPI_Status status;
  Mpi().Probe(from, tag, Mpi().world, &status);
  int bytes = 0;
  Mpi().Get_count(&status, Mpi().chars, &bytes);
  Message message{status.MPI_SOURCE, status.MPI_TAG,
                  std::string(static_cast<std::size_t>(bytes), 0)};
  Mpi().Recv(message.text.data(), bytes, Mpi().chars, message.from, message.tag, Mpi().world,
             MPI_STATUS_IGNORE);
  return message;
}

// A message if one has come. Its sender may die before it has all of it across: then `stop` ends
// the wait. `buffer` has to outlive that.
std::optional<Message> TryReceive(std::string& buffer, const std::atomic<bool>* stop) {
  int waiting = 0;
  MPI_Message handle = Mpi().no_message;
  MPI_Status status;
  Mpi().Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, Mpi().world, &waiting, &handle, &status);
  if (waiting == 0) return std::nullopt;
  int bytes = 0;
  Mpi().Get_count(&status, Mpi().chars, &bytes);
  buffer.assign(static_cast<std::size_t>(bytes), 0);
  MPI_Request request = Mpi().no_request;
  Mpi().Imrecv(buffer.data(), bytes, Mpi().chars, &handle, &request);
  for (int done = 0; done == 0;) {
    if (stop && *stop) return std::nullopt;
    Mpi().Test(&request, &done, MPI_STATUS_IGNORE);
  }
  return Message{status.MPI_SOURCE, status.MPI_TAG, buffer};
}

void Send(int to, int tag, const std::string& text) {
  Mpi().Send(text.data(), static_cast<int>(text.size()), Mpi().chars, to, tag, Mpi().world);
}

void SendRows(int to, const std::vector<int>& rows) {
  Mpi().Send(rows.data(), static_cast<int>(rows.size()), Mpi().ints, to, kRows, Mpi().world);
}

std::vector<int> ReceiveRows() {
  MPI_Status status;
  Mpi().Probe(0, kRows, Mpi().world, &status);
  int count = 0;
  Mpi().Get_count(&status, Mpi().ints, &count);
  std::vector<int> rows(static_cast<std::size_t>(count));
  Mpi().Recv(rows.data(), count, Mpi().ints, 0, kRows, Mpi().world, MPI_STATUS_IGNORE);
  return rows;
}

// "<row> <text>\n" for each row.
template <class Visit>
void ForEachRow(const std::string& text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at), blank = text.find(' ', at);
    int row = -1;
    std::from_chars(text.data() + at, text.data() + blank, row);
    visit(row, text.substr(blank + 1, end - blank - 1));
    at = end + 1;
  }
}

bool IsSet(const char* name) { return std::getenv(name) != nullptr; }

}  // namespace

// Rows on their way from rank 0. A send ends when its receiver next looks, which is after the rows
// it computes: nobody waits for that, and a rank that asks again has what was sent to it before.
// Others may die meanwhile: `stop` ends a wait.
class MpiJob::Post {
 public:
  void Send(int to, std::vector<int> rows, const std::atomic<bool>* stop) {
    Letter& letter = letters_[to];
    if (!HasArrived(letter, stop)) return;
    letter.rows = std::move(rows);
    Mpi().Isend(letter.rows.data(), static_cast<int>(letter.rows.size()), Mpi().ints, to, kRows,
                Mpi().world, &letter.request);
  }
  void AwaitAll(const std::atomic<bool>* stop) {
    for (auto& [to, letter] : letters_) HasArrived(letter, stop);
  }

 private:
  struct Letter {
    std::vector<int> rows;  // outlive the request
    MPI_Request request = Mpi().no_request;
  };
  static bool HasArrived(Letter& letter, const std::atomic<bool>* stop) {
    for (int done = letter.request == Mpi().no_request ? 1 : 0; done == 0;) {
      if (stop && *stop) return false;
      Mpi().Test(&letter.request, &done, MPI_STATUS_IGNORE);
    }
    return true;
  }
  std::map<int, Letter> letters_;
};

bool MpiJob::Launched() { return IsSet("OMPI_COMM_WORLD_SIZE") || IsSet("PMI_SIZE"); }

MpiJob::MpiJob() : post_(std::make_unique<Post>()) {
  Mpi().Init(nullptr, nullptr);
  Mpi().Comm_rank(Mpi().world, &rank_);
  Mpi().Comm_size(Mpi().world, &size_);
}

MpiJob::~MpiJob() {
  if (!took_part_) {
    // Bad input, told by rank 0: nobody is left waiting for rows.
    if (rank_ == 0)
      Dismiss();
    else
      Send(0, kLast, "");
  }
  Mpi().Finalize();
}

void MpiJob::Dismiss() {
  for (int left = size_ - 1; left > 0;) {
    const Message message = Receive(MPI_ANY_SOURCE, MPI_ANY_TAG);
    if (message.tag == kLast)
      --left;
    else
      SendRows(message.from, {});
  }
}

std::string MpiJob::Share(const std::string& text) {
  unsigned long long size = text.size();
  Mpi().Bcast(&size, 1, Mpi().unsigned_long_longs, 0, Mpi().world);
  std::string shared = text;
  shared.resize(size);
  Mpi().Bcast(shared.data(), static_cast<int>(size), Mpi().chars, 0, Mpi().world);
  return shared;
}

MpiJob::Served MpiJob::Serve(const std::vector<int>& rows, const Compute& compute,
                             const std::function<void(int row, const std::string& text)>& accept,
                             const std::atomic<bool>* stop) {
  took_part_ = true;
  Served served;
  std::size_t next = 0;
  int working = size_ - 1;
  const auto answer = [&](const Message& message) {
    ForEachRow(message.text, [&](int row, const std::string& text) {
      accept(row, text);
      served.lost[message.from].erase(row);
    });
    if (message.tag == kLast) {
      --working;
      return;
    }
    // Large chunks first, single rows at the end, so that all ranks finish together.
    const std::size_t left = rows.size() - next;
    const std::size_t chunk = std::min<std::size_t>(
        left,
        std::clamp<std::size_t>(left / (4 * static_cast<std::size_t>(size_)), 1, kLargestChunk));
    const auto first = rows.begin() + static_cast<std::ptrdiff_t>(next);
    const auto last = first + static_cast<std::ptrdiff_t>(chunk);
    next += chunk;
    served.lost[message.from].insert(first, last);
    post_->Send(message.from, {first, last}, stop);
  };
  while (working > 0 || next < rows.size()) {
    if (stop && *stop) {
      served.stopped = true;
      return served;
    }
    while (const auto message = TryReceive(incoming_, stop)) answer(*message);
    if (next < rows.size()) {
      const int row = rows[next++];
      accept(row, compute(row));
    } else if (working > 0) {
      // Waiting without spinning: the cores belong to the ranks that still compute.
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  post_->AwaitAll(stop);
  served.lost.clear();
  return served;
}

void MpiJob::Work(const Compute& compute) {
  took_part_ = true;
  Send(0, kAsk, "");
  std::string finished;
  for (std::vector<int> rows = ReceiveRows(); !rows.empty(); rows = ReceiveRows()) {
    // The next rows are asked for before these are computed: no rank waits for an answer.
    Send(0, kAsk, finished);
    finished.clear();
    for (const int row : rows) finished += std::to_string(row) + " " + compute(row) + "\n";
  }
  Send(0, kLast, finished);
}

void MpiJob::Abort(int code) {
  Mpi().Abort(Mpi().world, code);
  std::_Exit(code);
}

}  // namespace hoplab
