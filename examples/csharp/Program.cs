// The examples, one a file: dotnet run -- hello | pile | character | ragdoll | gun | rocks. Without a name: all.
var examples = new Dictionary<string, Action>
{
    ["hello"] = Hello.Run, ["pile"] = Pile.Run, ["character"] = Character.Run, ["ragdoll"] = Ragdoll.Run,
    ["gun"] = Gun.Run, ["rocks"] = Rocks.Run,
};
foreach (var (name, run) in examples)
{
    if (args.Length > 0 && args[0] != name) continue;
    Console.WriteLine($"--- {name}");
    run();
}
