// Breaches of the runtime's rules: each test makes one, and the stand-ins report it.

#include <cstring>
#include <thread>

#include <cuda_runtime_api.h>

#include "gpu/cuda_queue.h"
#include "gpu/task.h"
#include "tests/gpu/fake/fixture.h"

namespace dmoscope::gpu::fake {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class FakeRules : public ::testing::Test {
 protected:
  void SetUp() override {
    set_up({.devices = std::vector<FakeDevice>(2)});
    ASSERT_EQ(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), cudaSuccess);
    ASSERT_EQ(cudaMalloc(&memory, 64), cudaSuccess);
  }
  void TearDown() override { set_up({}); }
  void expect_told(const std::string& what) { EXPECT_THAT(breaches(), ElementsAre(HasSubstr(what))); }
  void begin_capture() { ASSERT_EQ(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal), cudaSuccess); }

  cudaStream_t stream = nullptr;
  void* memory = nullptr;
  std::byte host[64] = {};
};

TEST_F(FakeRules, WhatIsGivenBackTwice) {
  EXPECT_EQ(cudaFree(memory), cudaSuccess);
  EXPECT_NE(cudaFree(memory), cudaSuccess);
  expect_told("cudaFree of a piece of memory that does not exist");
}

TEST_F(FakeRules, WhatIsNotGivenBack) {
  EXPECT_THAT(leaks(), ElementsAre("1 of the pieces of device memory", "1 of the streams"));
  EXPECT_EQ(cudaFree(memory), cudaSuccess);
  EXPECT_EQ(cudaStreamDestroy(stream), cudaSuccess);
  EXPECT_THAT(leaks(), ::testing::IsEmpty());
}

TEST_F(FakeRules, AStreamThatIsGone) {
  EXPECT_EQ(cudaStreamDestroy(stream), cudaSuccess);
  EXPECT_NE(cudaMemsetAsync(memory, 0, 64, stream), cudaSuccess);
  expect_told("a stream that does not exist");
}

TEST_F(FakeRules, AnotherDeviceIsCurrent) {
  EXPECT_EQ(cudaSetDevice(1), cudaSuccess);
  EXPECT_EQ(cudaMemsetAsync(memory, 0, 64, stream), cudaSuccess);
  expect_told("a stream of device 0 while 1 is current");
}

TEST_F(FakeRules, BesideWhatWasAllocated) {
  EXPECT_NE(cudaMemsetAsync(memory, 0, 65, stream), cudaSuccess);
  expect_told("65 bytes beside what was allocated");
}

TEST_F(FakeRules, AllocatingInACapture) {
  begin_capture();
  void* more = nullptr;
  EXPECT_NE(cudaMalloc(&more, 8), cudaSuccess);
  expect_told("cudaMalloc in a capture");
  cudaGraph_t graph = nullptr;
  EXPECT_NE(cudaStreamEndCapture(stream, &graph), cudaSuccess) << "the capture is void";
  EXPECT_EQ(graph, nullptr);
}
TEST_F(FakeRules, WaitingInACapture) {
  begin_capture();
  EXPECT_NE(cudaStreamSynchronize(stream), cudaSuccess);
  expect_told("cudaStreamSynchronize in a capture");
}
TEST_F(FakeRules, AnotherDeviceInACapture) {
  begin_capture();
  EXPECT_EQ(cudaSetDevice(0), cudaSuccess) << "it is current already";
  EXPECT_NE(cudaSetDevice(1), cudaSuccess);
  expect_told("cudaSetDevice in a capture");
}
TEST_F(FakeRules, OrdinaryMemoryInACapture) {
  begin_capture();
  EXPECT_NE(cudaMemcpyAsync(host, memory, 64, cudaMemcpyDeviceToHost, stream), cudaSuccess);
  expect_told("a copy of ordinary memory in a capture");
}

/// A stream that waits for one that is captured is captured with it, until that one waits for it.
class FakeForks : public FakeRules {
 protected:
  void SetUp() override {
    FakeRules::SetUp();
    ASSERT_EQ(cudaStreamCreateWithFlags(&side, cudaStreamNonBlocking), cudaSuccess);
    for (cudaEvent_t* event : {&forked, &joined}) ASSERT_EQ(cudaEventCreateWithFlags(event, cudaEventDisableTiming), cudaSuccess);
    begin_capture();
    EXPECT_EQ(cudaEventRecord(forked, stream), cudaSuccess);
    EXPECT_EQ(cudaStreamWaitEvent(side, forked, 0), cudaSuccess);
    work();
  }
  void work() { EXPECT_EQ(cudaMemsetAsync(memory, 7, 64, side), cudaSuccess); }
  void join() {
    EXPECT_EQ(cudaEventRecord(joined, side), cudaSuccess);
    EXPECT_EQ(cudaStreamWaitEvent(stream, joined, 0), cudaSuccess);
  }
  cudaError_t end() { return cudaStreamEndCapture(stream, &graph); }
  std::byte first_byte() {
    EXPECT_EQ(cudaStreamSynchronize(side), cudaSuccess);
    EXPECT_EQ(cudaStreamSynchronize(stream), cudaSuccess);
    EXPECT_EQ(cudaMemcpyAsync(host, memory, 64, cudaMemcpyDeviceToHost, stream), cudaSuccess);
    EXPECT_EQ(cudaStreamSynchronize(stream), cudaSuccess);
    return host[0];
  }
  cudaStream_t side = nullptr;
  cudaEvent_t forked = nullptr, joined = nullptr;
  cudaGraph_t graph = nullptr;
};

TEST_F(FakeForks, AreKeptWithTheCapture) {
  join();
  ASSERT_EQ(end(), cudaSuccess);
  EXPECT_NE(first_byte(), std::byte{7}) << "it is kept, not done";
  cudaGraphExec_t executable = nullptr;
  ASSERT_EQ(cudaGraphInstantiate(&executable, graph, 0), cudaSuccess);
  EXPECT_EQ(cudaGraphLaunch(executable, stream), cudaSuccess);
  EXPECT_EQ(first_byte(), std::byte{7});
  EXPECT_THAT(breaches(), ::testing::IsEmpty());
}
TEST_F(FakeForks, ThatNobodyWaitsForVoidTheCapture) {
  EXPECT_EQ(end(), cudaErrorStreamCaptureUnjoined);
  EXPECT_EQ(graph, nullptr);
  work();
  EXPECT_EQ(first_byte(), std::byte{7}) << "the stream is by itself again";
}
TEST_F(FakeForks, WithWorkAfterTheirMarkVoidTheCapture) {
  EXPECT_EQ(cudaEventRecord(joined, side), cudaSuccess);
  work();
  EXPECT_EQ(cudaStreamWaitEvent(stream, joined, 0), cudaSuccess);
  EXPECT_EQ(end(), cudaErrorStreamCaptureUnjoined);
}
TEST_F(FakeForks, ACaptureWaitsForWhatIsNotCaptured) {
  join();
  cudaStream_t third = nullptr;
  ASSERT_EQ(cudaEventDestroy(forked), cudaSuccess);
  std::thread([&] {
    EXPECT_EQ(cudaStreamCreateWithFlags(&third, cudaStreamNonBlocking), cudaSuccess);
    EXPECT_EQ(cudaEventCreateWithFlags(&forked, cudaEventDisableTiming), cudaSuccess);
    EXPECT_EQ(cudaEventRecord(forked, third), cudaSuccess);
  }).join();
  EXPECT_EQ(cudaStreamWaitEvent(stream, forked, 0), cudaErrorStreamCaptureIsolation);
  expect_told("a capture waits for what is not captured");
}

TEST_F(FakeRules, WhatIsReadTooEarlyIsNotThere) {
  EXPECT_EQ(cudaMemsetAsync(memory, 7, 64, stream), cudaSuccess);
  EXPECT_EQ(cudaMemcpyAsync(host, memory, 64, cudaMemcpyDeviceToHost, stream), cudaSuccess);
  EXPECT_EQ(host[0], std::byte{0xcd});
  EXPECT_EQ(cudaStreamSynchronize(stream), cudaSuccess);
  EXPECT_EQ(host[0], std::byte{7});
  EXPECT_THAT(breaches(), ::testing::IsEmpty());
}
TEST_F(FakeRules, NobodyWaitsForACopyOfOrdinaryMemory) {
  EXPECT_EQ(cudaMemcpyAsync(host, memory, 64, cudaMemcpyDeviceToHost, stream), cudaSuccess);
  EXPECT_EQ(cudaFree(memory), cudaSuccess);
  expect_told("cudaFree is called while a copy of ordinary memory of the host is under way");
}
TEST_F(FakeRules, MemoryThatChangesBeforeItIsCopied) {
  EXPECT_EQ(cudaMemcpyAsync(memory, host, 64, cudaMemcpyHostToDevice, stream), cudaSuccess);
  host[5] = std::byte{1};
  EXPECT_EQ(cudaStreamSynchronize(stream), cudaSuccess);
  expect_told("changed before it was copied");
}
TEST_F(FakeRules, HostMemoryThatADeviceHasYetToWrite) {
  void* pinned = nullptr;
  EXPECT_EQ(cudaMallocHost(&pinned, 64), cudaSuccess);
  EXPECT_EQ(cudaMemcpyAsync(pinned, memory, 64, cudaMemcpyDeviceToHost, stream), cudaSuccess);
  EXPECT_EQ(cudaFreeHost(pinned), cudaSuccess);
  expect_told("that a device has yet to write");
}

/// Errors that end a context, by CUDA's documentation.
TEST_F(FakeRules, ALostDeviceStaysLostAndOtherErrorsPass) {
  fail_at(1, kOperatingSystem);
  EXPECT_EQ(cudaStreamSynchronize(stream), cudaErrorOperatingSystem);
  EXPECT_EQ(cudaStreamSynchronize(stream), cudaSuccess);
  EXPECT_EQ(cudaGetLastError(), cudaErrorOperatingSystem);
  EXPECT_EQ(cudaGetLastError(), cudaSuccess);
  fail_at(1, kTimeout);
  EXPECT_EQ(cudaMemsetAsync(memory, 0, 8, stream), cudaErrorLaunchTimeout);
  EXPECT_EQ(cudaStreamSynchronize(stream), cudaErrorLaunchTimeout);
  EXPECT_EQ(cudaGetLastError(), cudaErrorLaunchTimeout);
}

/// The first launch of a kernel loads it, which may wait for the device.
TEST_F(FakeRules, AKernelThatIsNewInACapture) {
  const auto queue = make_cuda_queue(0);
  (void)queue->record([&] { queue->launch(Work::Conclude, Metric::MeanRatio, Task{}, 1); });
  expect_told("is launched for the first time in a capture");
}

TEST_F(FakeRules, AMappingWithoutARegistration) {
  EXPECT_NE(cudaGraphicsUnregisterResource(nullptr), cudaSuccess);
  expect_told("cudaGraphicsUnregisterResource of a buffer that is not registered");
}

}  // namespace
}  // namespace dmoscope::gpu::fake
