// What the tests run besides xunit:
//   laws (one by one, as on mono) | scenario [workers] | fuzz seconds [seed] | threads seconds [rounds] | cost
using System;
using System.Globalization;
using System.Reflection;

namespace FeatherPhysics.Tests
{
    static class Program
    {
        static int RunLaws()
        {
            int passed = 0, failed = 0;
            const BindingFlags all = BindingFlags.Public | BindingFlags.Static | BindingFlags.DeclaredOnly;
            foreach (MethodInfo law in typeof(Laws).GetMethods(all))
                try
                {
                    law.Invoke(null, null);
                    ++passed;
                }
                catch (TargetInvocationException e)
                {
                    Console.WriteLine("FAILED " + law.Name + ": " + e.InnerException);
                    ++failed;
                }
            Console.WriteLine("[  PASSED  ] " + passed + " test(s).");
            if (failed > 0) Console.WriteLine("[  FAILED  ] " + failed + " test(s).");
            return failed > 0 ? 1 : 0;
        }

        static int Main(string[] arguments)
        {
            string what = arguments.Length > 0 ? arguments[0] : "laws";
            if (what == "laws") return RunLaws();
            if (what == "scenario") Scenario.Run(arguments.Length > 1 ? int.Parse(arguments[1]) : 1);
            else if (what == "fuzz")
                Fuzz.Run(double.Parse(arguments[1], CultureInfo.InvariantCulture),
                    arguments.Length > 2 ? int.Parse(arguments[2]) : 1);
            else if (what == "threads")
                Threads.Run(double.Parse(arguments[1], CultureInfo.InvariantCulture),
                    arguments.Length > 2 ? int.Parse(arguments[2]) : 1);
#if NET
            else if (what == "cost") Cost.Print();
#endif
            else return 2;
            return 0;
        }
    }
}
