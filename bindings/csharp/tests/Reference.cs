// The page of reference has every public name of the assembly, and no other.
using System;
using System.Collections.Generic;
using System.IO;
using System.Linq;
using System.Reflection;
using System.Text.RegularExpressions;

namespace FeatherPhysics.Tests
{
    public static partial class Laws
    {
        /// Type: the names of its members, as docs/reference/csharp.md has them.
        static Dictionary<string, HashSet<string>> Paged()
        {
            string text = File.ReadAllText(Path.Combine(Root, "docs/reference/csharp.md"));
            Dictionary<string, HashSet<string>> groups = new Dictionary<string, HashSet<string>>();
            foreach (string part in Regex.Split(text, "^## ", RegexOptions.Multiline).Skip(2))
            {
                string title = part.Substring(0, part.IndexOf('\n'));
                HashSet<string> names = groups[title] = new HashSet<string>();
                foreach (Match line in Regex.Matches(part, "^\\*\\*`([^`]*)`\\*\\*", RegexOptions.Multiline))
                    names.Add(NameOf(line.Groups[1].Value));
                foreach (Match row in Regex.Matches(part, "^\\| `(\\w+)", RegexOptions.Multiline))
                    names.Add(row.Groups[1].Value);
                foreach (Match also in Regex.Matches(part, "^Also: (.*)$", RegexOptions.Multiline))
                    foreach (Match name in Regex.Matches(also.Groups[1].Value, "`([^`]*)`"))
                        names.Add(name.Groups[1].Value);
            }
            return groups;
        }

        /// The name in a signature.
        static string NameOf(string signature)
        {
            string text = signature.Replace('\n', ' ');
            if (Regex.IsMatch(text, @"^(\w+ )*(class|struct|enum|delegate) ")) return "";
            if (text.Contains("operator ")) return "operator";
            if (text.Contains(" this[")) return "this[]";
            Match method = Regex.Match(text, @"(\w+)(<\w+>)?\(");
            return method.Success ? method.Groups[1].Value : Regex.Match(text, @"(\w+) \{").Groups[1].Value;
        }

        static string NameOf(MemberInfo member)
        {
            if (member is ConstructorInfo) return member.DeclaringType.Name;
            if (member.Name.StartsWith("op_", StringComparison.Ordinal)) return "operator";
            PropertyInfo property = member as PropertyInfo;
            return property != null && property.GetIndexParameters().Length > 0 ? "this[]" : member.Name;
        }

        static IEnumerable<string> MembersOf(Type type)
        {
            const BindingFlags all = BindingFlags.Public | BindingFlags.Static | BindingFlags.Instance |
                BindingFlags.DeclaredOnly;
            if (typeof(Delegate).IsAssignableFrom(type)) return new string[0];
            return type.GetMembers(all).Where(IsWritten).Select(NameOf);
        }

        /// No accessor, nor what an enum or the compiler has of its own.
        static bool IsWritten(MemberInfo member)
        {
            MethodBase method = member as MethodBase;
            bool isAccessor = method is MethodInfo && method.IsSpecialName && !method.Name.StartsWith("op_", StringComparison.Ordinal);
            return !isAccessor && member.Name != "value__" && !(member is Type);
        }

        public static void The_page_of_reference_has_every_public_name()
        {
            Dictionary<string, HashSet<string>> groups = Paged();
            List<string> wrong = new List<string>();
            List<Type> types = typeof(World).Assembly.GetExportedTypes().Where(IsOfTheLayer).ToList();
            foreach (Type type in types)
            {
                string title = type.FullName.Replace("FeatherPhysics.", "").Replace('+', '.');
                HashSet<string> paged;
                if (!groups.TryGetValue(title, out paged))
                {
                    wrong.Add(title);
                    continue;
                }
                HashSet<string> there = new HashSet<string>(MembersOf(type));
                // a constructor that nobody wrote is not in the page, and == stands among what every value has
                wrong.AddRange(there.Except(paged).Where(n => n != type.Name)
                    .Where(n => n != "operator" || !paged.Contains("operator ==")).Select(n => title + "." + n));
                wrong.AddRange(paged.Except(there).Where(n => n != "" && !n.StartsWith("operator ", StringComparison.Ordinal))
                    .Select(n => title + "." + n + ", which is not there"));
            }
            Check.Same(string.Join(", ", wrong), "", "names that differ");
            Check.Same(groups.Count, types.Count, "types");
        }

        /// On mono the tests and the layer are one program.
        static bool IsOfTheLayer(Type type) { return type.Namespace == "FeatherPhysics"; }
    }
}
