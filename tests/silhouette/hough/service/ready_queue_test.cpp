#include "silhouette/hough/service/ready_queue.h"

#include <doctest/doctest.h>

#include <array>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <thread>
#include <vector>

namespace rimline {
namespace {

TEST_CASE("the queue keeps the order of pushes and puts who comes back behind the others") {
    ReadyQueue queue;
    std::array<ReadyQueue::Node, 3> nodes;
    for (ReadyQueue::Node& node : nodes) queue.push(node);
    CHECK(queue.pop() == &nodes[0]);
    queue.push(nodes[0]);
    CHECK(queue.pop() == &nodes[1]);
    queue.push(nodes[1]);
    CHECK(queue.pop() == &nodes[2]);
    CHECK(queue.pop() == &nodes[0]);
    CHECK(queue.pop() == &nodes[1]);
}

TEST_CASE("no push is slept through") {
    for (const int worker_count : {1, 3}) {
        CAPTURE(worker_count);
        ReadyQueue queue;
        std::array<ReadyQueue::Node, 4> nodes;
        std::atomic<std::uint32_t> popped{0};
        std::vector<std::thread> workers;
        for (int i = 0; i < worker_count; ++i)
            workers.emplace_back([&] {
                while (queue.pop() != nullptr) {
                    ++popped;
                    popped.notify_all();
                }
            });
        // One at a time finds the workers asleep or about to be, four at a time some of them.
        std::uint32_t pushed = 0;
        for (std::uint32_t round = 0; round < 5000; ++round) {
            const std::uint32_t burst = round % 2 == 0 ? 1 : 4;
            for (std::uint32_t i = 0; i < burst; ++i) queue.push(nodes[i]);
            pushed += burst;
            for (std::uint32_t now = popped; now != pushed; now = popped) popped.wait(now);
        }
        queue.close();
        for (std::thread& worker : workers) worker.join();
        CHECK(popped == pushed);
    }
}

TEST_CASE("two pushes in a row keep two workers busy at once") {
    ReadyQueue queue;
    std::array<ReadyQueue::Node, 2> nodes;
    std::barrier both(2);  // Each worker holds on to what it has until the other has something too.
    std::atomic<std::uint32_t> popped{0};
    std::vector<std::thread> workers;
    for (int i = 0; i < 2; ++i)
        workers.emplace_back([&] {
            while (queue.pop() != nullptr) {
                both.arrive_and_wait();
                ++popped;
                popped.notify_all();
            }
        });
    const std::uint32_t rounds = 2000;
    for (std::uint32_t round = 1; round <= rounds; ++round) {
        for (ReadyQueue::Node& node : nodes) queue.push(node);
        for (std::uint32_t now = popped; now != 2 * round; now = popped) popped.wait(now);
    }
    queue.close();
    for (std::thread& worker : workers) worker.join();
    CHECK(popped == 2 * rounds);
}

TEST_CASE("who is pushed from many threads is popped once a push") {
    struct Item : ReadyQueue::Node {
        std::atomic<bool> queued{false};
    };
    ReadyQueue queue;
    std::array<Item, 16> items;
    std::atomic<std::uint32_t> pops{0};
    std::vector<std::thread> workers;
    for (int i = 0; i < 2; ++i)
        workers.emplace_back([&] {
            while (ReadyQueue::Node* node = queue.pop()) {
                static_cast<Item*>(node)->queued = false;
                ++pops;
            }
        });
    std::vector<std::thread> pushers;
    const std::uint32_t pushes_each = 4000;
    for (std::uint32_t p = 0; p < 3; ++p)
        pushers.emplace_back([&, p] {
            std::uint32_t pushes = 0;
            for (std::uint32_t i = 0; pushes < pushes_each; ++i) {
                Item& item = items[(i * (p + 1)) % items.size()];
                if (item.queued.exchange(true)) {
                    if (i % 16 == 0) std::this_thread::yield();
                    continue;
                }
                queue.push(item);
                ++pushes;
            }
        });
    for (std::thread& pusher : pushers) pusher.join();
    for (const Item& item : items)
        while (item.queued) std::this_thread::yield();
    queue.close();
    for (std::thread& worker : workers) worker.join();
    CHECK(pops == 3 * pushes_each);
}

TEST_CASE("closing wakes all and leaves the rest in the queue") {
    ReadyQueue queue;
    std::vector<std::thread> workers;
    std::atomic<int> ended{0};
    for (int i = 0; i < 4; ++i)
        workers.emplace_back([&] {
            while (queue.pop() != nullptr) {
            }
            ++ended;
        });
    queue.close();
    for (std::thread& worker : workers) worker.join();
    CHECK(ended == 4);
    ReadyQueue::Node node;
    queue.push(node);
    CHECK(queue.pop() == nullptr);
}

TEST_CASE("workers with nothing to do use no processor") {
    ReadyQueue queue;
    std::vector<std::thread> workers;
    ReadyQueue::Node node;
    std::atomic<bool> is_popped{false};
    for (int i = 0; i < 2; ++i)
        workers.emplace_back([&] {
            while (queue.pop() != nullptr) is_popped = true;
        });
    queue.push(node);
    while (!is_popped) std::this_thread::yield();
    const std::clock_t before = std::clock();  // Of the whole process, not of the day.
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const double used_s = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    CHECK(used_s < 0.1);
    queue.close();
    for (std::thread& worker : workers) worker.join();
}

}  // namespace
}  // namespace rimline
