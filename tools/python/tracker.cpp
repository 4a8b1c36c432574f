#include "tools/python/tracker.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <thread>

#include "silhouette/hough/service/silhouette_service.h"
#include "silhouette/hough/silhouette_tracker.h"
#include "tools/python/arrays.h"
#include "tools/python/bound_class.h"
#include "tools/python/long_calls.h"
#include "tools/python/mesh.h"
#include "tools/python/unlocked.h"

namespace rimline::python {

namespace py = pybind11;

namespace {

// Its arrays are views of `change`, which they keep alive.
struct PythonChange {
    PublishedChange change;
    ChangeSet view() const { return change.view(); }
};

template <typename Element>
py::array view_of(const py::object& self, std::span<const Element> ChangeSet::*member) {
    const std::span<const Element> elements = self.cast<const PythonChange&>().view().*member;
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(elements.size())};
    if constexpr (sizeof(Element) == 8) shape.push_back(2);
    return array_over<std::uint32_t>(elements.data(), std::move(shape), self);
}

// Change sets for Python. The memory of the last one is used again where nobody holds it any more.
class ChangeSets {
public:
    /// Nobody but the caller has it, until give_back().
    py::object take() {
        if (last_ && Py_REFCNT(last_.ptr()) == 1 && !has_weak_references(last_))
            return std::move(last_);
        return py::cast(std::make_unique<PythonChange>());
    }
    void give_back(const py::object& change) { last_ = change; }

private:
    static bool has_weak_references(const py::object& change) {
        return reinterpret_cast<const py::detail::instance*>(change.ptr())->weakrefs != nullptr;
    }

    py::object last_;
};

class PythonTracker {
public:
    PythonTracker(const py::object& mesh, const py::object& eye, const py::object& direction,
                  const py::object& progress)
        : mesh_(mesh_of(mesh)) {
        const HomogeneousPoint point = point_of(eye, direction);
        run_long(progress, [&](const LongCall& call) {
            tracker_ = std::make_unique<SilhouetteTracker>(mesh_->octree(call), point);
        });
    }

    py::object move_to(const py::object& eye, const py::object& direction) {
        const HomogeneousPoint point = point_of(eye, direction);
        py::object change = changes_.take();
        auto& published = change.cast<PythonChange&>().change;
        {
            const Unlocked unlocked;
            const std::lock_guard lock(*mutex_);
            published.assign(tracker_->move_to(point), {});
        }
        changes_.give_back(change);
        return change;
    }

    /// What read(tracker) copies while it does not move. `read` must make no Python objects: the garbage collector
    /// could then run code that uses this tracker.
    template <typename Read>
    auto read(Read read) const {
        const Unlocked unlocked;
        const std::lock_guard lock(*mutex_);
        return read(*tracker_);
    }
    std::vector<EdgeId> silhouette() const {
        return read([](const SilhouetteTracker& tracker) { return copy_of(tracker.silhouette()); });
    }
    std::vector<std::uint32_t> face_words() const {
        return read([](const SilhouetteTracker& tracker) { return copy_of(tracker.face_words()); });
    }
    std::uint64_t sequence() const {
        return read([](const SilhouetteTracker& tracker) { return tracker.sequence(); });
    }
    HomogeneousPoint point() const {
        return read([](const SilhouetteTracker& tracker) { return tracker.point(); });
    }
    const Mesh& mesh() const { return tracker_->mesh(); }

private:
    template <typename Element>
    static std::vector<Element> copy_of(std::span<const Element> elements) {
        return {elements.begin(), elements.end()};
    }

    SharedMesh mesh_;
    std::unique_ptr<SilhouetteTracker> tracker_;
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
    ChangeSets changes_;
};

py::array front_of_words(std::span<const std::uint32_t> words, std::uint32_t face_count) {
    py::array_t<bool> result(face_count);
    bool* bits = result.mutable_data();
    for (std::uint32_t face = 0; face < face_count; ++face)
        bits[face] = face_bit(words, FaceId{face});
    return result;
}

py::tuple tuple_of(const HomogeneousPoint& point) {
    return py::make_tuple(point.x, point.y, point.z, point.w);
}

struct PythonSnapshot {
    SilhouetteSnapshot snapshot;
    std::uint32_t face_count;
};

// More threads than any machine has use for, and fewer than a process can have.
constexpr std::uint32_t k_max_workers = 1024;

class PythonService {
public:
    PythonService(const py::object& workers, const py::object& max_pending) {
        service_ = std::make_unique<SilhouetteService>(
            SilhouetteServiceOptions{.workers = count_of(workers, "workers", 0, k_max_workers),
                                     .max_pending = count_of(max_pending, "max_pending", 1)});
    }
    PythonService(const PythonService&) = delete;
    PythonService& operator=(const PythonService&) = delete;
    ~PythonService() {
        if (is_here())
            stop();
        else
            static_cast<void>(service_.release());  // Its end would wait for the workers.
    }

    /// False in a child of fork(), which has none of the workers.
    bool is_here() const { return getpid() == process_; }
    SilhouetteService& service() const {
        if (!is_here())
            throw Error(ErrorCode::cancelled,
                        "the service works only in the process that made it, not in its children");
        return *service_;
    }
    void stop() {
        if (!is_here()) return;
        const Unlocked unlocked;
        service_->stop();
        is_stopped_ = true;
    }
    /// Then no more change sets come than are pending.
    bool is_stopped() const { return is_stopped_; }

private:
    const pid_t process_ = getpid();
    std::unique_ptr<SilhouetteService> service_;
    std::atomic<bool> is_stopped_ = false;
};

// A tracker of a service, which it removes at its end.
class ServiceTracker {
public:
    ServiceTracker(py::object service, SharedMesh mesh, const HomogeneousPoint& point,
                   const py::object& progress)
        : service_(std::move(service)), mesh_(std::move(mesh)) {
        SilhouetteService& running = this->service();
        try {
            run_long(progress,
                     [&](const LongCall& call) { id_ = running.add(mesh_->octree(call), point); });
        } catch (...) {
            if (id_ != k_no_tracker) remove();  // Ctrl-C came later.
            throw;
        }
    }
    ~ServiceTracker() {
        if (service_.cast<const PythonService&>().is_here()) remove();
    }
    ServiceTracker(const ServiceTracker&) = delete;
    ServiceTracker& operator=(const ServiceTracker&) = delete;

    bool remove() {
        SilhouetteService& running = service();
        const Unlocked unlocked;
        return running.remove(id_);
    }
    void post(const py::object& eye, const py::object& direction) {
        if (!service().post(id_, point_of(eye, direction)))
            throw Error(ErrorCode::cancelled,
                        "the tracker was removed, or its service was stopped");
    }

    // None where nothing came within `timeout_s`.
    py::object take(const py::object& timeout) {
        const double timeout_s = number_of(timeout, "timeout");
        if (!(timeout_s >= 0.0)) throw py::value_error("timeout: expected 0 seconds or more");
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        py::object change = changes_.take();
        auto& published = change.cast<PythonChange&>().change;
        for (;;) {
            const bool is_last = service_.cast<const PythonService&>().is_stopped();
            switch (service().take(id_, published)) {
                case Taken::nothing:
                    if (is_last) throw Error(ErrorCode::cancelled, "the service was stopped");
                    break;
                case Taken::change: changes_.give_back(change); return change;
                case Taken::gap:
                    throw Error(ErrorCode::too_large,
                                "memory was short and a change set was lost: take a snapshot()");
                case Taken::removed: throw Error(ErrorCode::cancelled, "the tracker was removed");
            }
            const double waited_s = std::chrono::duration<double>(Clock::now() - start).count();
            if (!(waited_s < timeout_s)) {
                changes_.give_back(change);
                return py::none();
            }
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
            const Unlocked unlocked;
            // Moves take some 20 microseconds to a millisecond.
            std::this_thread::sleep_for(std::chrono::microseconds(waited_s < 1e-3 ? 20 : 500));
        }
    }

    std::unique_ptr<PythonSnapshot> snapshot() {
        auto result = std::make_unique<PythonSnapshot>();
        result->face_count = mesh_->mesh().face_count();
        SilhouetteService& running = service();
        const Unlocked unlocked;
        if (!running.snapshot(id_, result->snapshot))
            throw Error(ErrorCode::cancelled, "the tracker was removed");
        return result;
    }

private:
    SilhouetteService& service() const { return service_.cast<const PythonService&>().service(); }

    py::object service_;
    SharedMesh mesh_;
    TrackerId id_ = k_no_tracker;
    ChangeSets changes_;
};

void bind_change_set(py::module_& module) {
    bound_class<PythonChange>(
        module, "ChangeSet",
        "What changed between two silhouettes of one mesh. Its arrays are views that stay valid "
        "as long as they live.\n\n"
        "With the slots and words of the sequence before, `slots[c.slots[:, 0]] = c.slots[:, 1]` "
        "and likewise `words` give those of this one. An array of slots needs len(mesh.edges) of "
        "them: the first silhouette_size are in use, and that number grows and shrinks.")
        .def_property_readonly(
            "flipped", [](const py::object& s) { return view_of(s, &ChangeSet::flipped); },
            "N uint32: faces that turned, each once.")
        .def_property_readonly(
            "added", [](const py::object& s) { return view_of(s, &ChangeSet::added); },
            "N uint32: edges that joined the silhouette, as rows of Mesh.edges.")
        .def_property_readonly(
            "removed", [](const py::object& s) { return view_of(s, &ChangeSet::removed); },
            "N uint32: edges that left it.")
        .def_property_readonly(
            "slots", [](const py::object& s) { return view_of(s, &ChangeSet::slots); },
            "N x 2 uint32: slot and edge of each slot that changed. Slots are less than "
            "len(mesh.edges).")
        .def_property_readonly(
            "words", [](const py::object& s) { return view_of(s, &ChangeSet::words); },
            "N x 2 uint32: word and bits of each word of face bits that changed; face f is bit "
            "f % 32 of word f // 32.")
        .def_property_readonly(
            "sequence", [](const PythonChange& c) { return c.view().sequence; },
            "One more than that of the change set before.")
        .def_property_readonly(
            "silhouette_size", [](const PythonChange& c) { return c.view().silhouette_size; },
            "The number of edges of the silhouette after the change.")
        .def_property_readonly(
            "point", [](const PythonChange& c) { return tuple_of(c.view().point); },
            "x, y, z, and 1 for a viewpoint or 0 for a direction.")
        .def_property_readonly(
            "box_checks", [](const PythonChange& c) { return c.view().counters.box_checks; },
            "Boxes of the index that the move looked at.")
        .def_property_readonly(
            "face_checks", [](const PythonChange& c) { return c.view().counters.face_checks; },
            "Faces whose planes it looked at.")
        .def("__repr__", [](const PythonChange& c) {
            const ChangeSet changes = c.view();
            return "<rimline.ChangeSet " + std::to_string(changes.sequence) + ": " +
                   std::to_string(changes.added.size()) + " edges joined, " +
                   std::to_string(changes.removed.size()) + " left, " +
                   std::to_string(changes.silhouette_size) + " in all>";
        });
}

}  // namespace

void bind_tracker(py::module_& module) {
    bind_change_set(module);

    bound_class<PythonTracker>(
        module, "Tracker",
        "The silhouette of one mesh from a moving point. Several trackers may share a mesh; one "
        "that several threads use moves for one after the other.")
        .def(py::init<const py::object&, const py::object&, const py::object&, const py::object&>(),
             py::arg("mesh"), py::arg("eye") = py::none(), py::kw_only(),
             py::arg("direction") = py::none(), py::arg("progress") = py::none(),
             "Starts at a viewpoint or a direction towards the viewer. Makes the index of the "
             "mesh if it has none.")
        .def("move_to", &PythonTracker::move_to, py::arg("eye") = py::none(), py::kw_only(),
             py::arg("direction") = py::none(),
             "Moves to a viewpoint or a direction, and returns what changed.")
        .def_property_readonly(
            "silhouette",
            [](const PythonTracker& t) {
                return copied<std::uint32_t>(std::span<const EdgeId>(t.silhouette()));
            },
            "N uint32: the edges of the silhouette, as rows of Mesh.edges, in the order of slots. "
            "It is the beginning of the array that ChangeSet.slots needs, which has "
            "len(mesh.edges).")
        .def_property_readonly(
            "edges", [](const PythonTracker& t) { return edge_vertices(t.mesh(), t.silhouette()); },
            "N x 2 uint32: the same as vertices.")
        .def_property_readonly(
            "front_faces",
            [](const PythonTracker& t) {
                return front_of_words(t.face_words(), t.mesh().face_count());
            },
            "F bool: whether each face is seen from its front.")
        .def_property_readonly(
            "face_words",
            [](const PythonTracker& t) {
                return copied<std::uint32_t>(std::span<const std::uint32_t>(t.face_words()));
            },
            "uint32: the same packed, 32 faces a word.")
        .def_property_readonly("sequence", &PythonTracker::sequence,
                               "That of the last change set; 0 before the first move.")
        .def_property_readonly(
            "point", [](const PythonTracker& t) { return tuple_of(t.point()); },
            "x, y, z, and 1 for a viewpoint or 0 for a direction.");

    bound_class<PythonSnapshot>(
        module, "Snapshot", "The whole state of a tracker, to which the next change set applies.")
        .def_property_readonly(
            "slots",
            [](const py::object& self) {
                const auto& slots = self.cast<const PythonSnapshot&>().snapshot.slots;
                return array_over<std::uint32_t>(slots.data(),
                                                 {static_cast<py::ssize_t>(slots.size())}, self);
            },
            "N uint32: the edges of the silhouette. They are the beginning of the array that "
            "ChangeSet.slots needs, which has len(mesh.edges).")
        .def_property_readonly(
            "words",
            [](const py::object& self) {
                const auto& words = self.cast<const PythonSnapshot&>().snapshot.words;
                return array_over<std::uint32_t>(words.data(),
                                                 {static_cast<py::ssize_t>(words.size())}, self);
            },
            "uint32: bits of faces, 32 a word.")
        .def_property_readonly(
            "front_faces",
            [](const PythonSnapshot& s) { return front_of_words(s.snapshot.words, s.face_count); },
            "F bool: whether each face is seen from its front.")
        .def_property_readonly(
            "sequence", [](const PythonSnapshot& s) { return s.snapshot.sequence; },
            "That of the last change set in it.")
        .def_property_readonly(
            "point", [](const PythonSnapshot& s) { return tuple_of(s.snapshot.point); },
            "x, y, z, and 1 for a viewpoint or 0 for a direction.");

    bound_class<ServiceTracker>(module, "ServiceTracker", "A tracker of a SilhouetteService.")
        .def("post", &ServiceTracker::post, py::arg("eye") = py::none(), py::kw_only(),
             py::arg("direction") = py::none(),
             "Asks for a move. Does not wait; a newer point takes the place of an older one that "
             "no worker has begun with.")
        .def("take", &ServiceTracker::take, py::arg("timeout") = 0.0,
             "The next change set, in order and without gaps; None where there is none within "
             "`timeout` seconds.")
        .def("snapshot", &ServiceTracker::snapshot,
             "The whole state, and drops change sets up to it. Take one first.")
        .def("remove", &ServiceTracker::remove,
             "Drops the tracker. False if it was removed before.");

    bound_class<PythonService>(
        module, "SilhouetteService",
        "Many trackers, moved by threads of the library. A context manager. It and its "
        "trackers work in the process that made it: in a child of fork they raise "
        "CancelledError.")
        .def(py::init<const py::object&, const py::object&>(), py::kw_only(),
             py::arg("workers") = 0, py::arg("max_pending") = 4,
             "workers: threads, 1024 at most; 0: one less than the processor has. max_pending: "
             "change sets that "
             "wait to be taken before a tracker waits.")
        .def(
            "add",
            [](py::object self, const py::object& mesh, const py::object& eye,
               const py::object& direction, const py::object& progress) {
                self.cast<const PythonService&>();  // TypeError where it was not made.
                return std::make_unique<ServiceTracker>(std::move(self), mesh_of(mesh),
                                                        point_of(eye, direction), progress);
            },
            py::arg("mesh"), py::arg("eye") = py::none(), py::kw_only(),
            py::arg("direction") = py::none(), py::arg("progress") = py::none(),
            "Adds a tracker at a viewpoint or a direction.")
        .def("stop", &PythonService::stop, "Ends the workers. Points not reached are dropped.")
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](PythonService& self, const py::args&) { self.stop(); })
        .def_property_readonly(
            "worker_count", [](const PythonService& self) { return self.service().worker_count(); },
            "Threads that move trackers.");
}

}  // namespace rimline::python
