// The laws, and what only .NET can measure, as tests of xunit.
using System;
using System.Collections.Generic;
using System.Reflection;
using Xunit;

namespace FeatherPhysics.Tests
{
    public class Suite
    {
        public static IEnumerable<object[]> Names()
        {
            const BindingFlags all = BindingFlags.Public | BindingFlags.Static | BindingFlags.DeclaredOnly;
            foreach (MethodInfo law in typeof(Laws).GetMethods(all)) yield return new object[] { law.Name };
        }

        [Theory]
        [MemberData(nameof(Names))]
        public void Law(string name)
        {
            ((Action)Delegate.CreateDelegate(typeof(Action), typeof(Laws).GetMethod(name)))();
        }

        [Fact]
        public void Steps_queries_events_and_snapshots_allocate_nothing() { Assert.Equal(0, Cost.BytesOfSteps(2000)); }

        [Fact]
        public void Batches_allocate_nothing() { Assert.Equal(0, Cost.BytesOfBatch(200)); }
    }
}
